import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Decodes photos on demand and keeps the latest within a byte budget.
///
/// Thread-safe. What it returns depends on the arguments only, never on what is kept.
package final class ImageStore: Sendable {
  private struct Key: Hashable {
    var photo: ID<Photo>
    var width: Int
    var height: Int
    var isMask = false
  }

  private struct Cache {
    var images: [Key: (image: RasterImage, lastUse: Int)] = [:]
    var byteCount = 0
    var clock = 0
  }

  private let photos: [Photo]
  private let images: [RasterImage]
  private let masks: [RasterImage?]
  private let byteBudget: Int
  private let processingPixels: Int?
  private let contentHashes: [UInt64]
  private let cache = Locked(Cache())

  /// `byteBudget` bounds the images that are kept between calls, not those a caller holds. No image
  /// is larger than `processingPixels`. `contentHashes`, by photo id, save reading files again where
  /// they are known.
  package init(
    photos: [Photo], byteBudget: Int = 1 << 30, processingPixels: Int? = nil,
    contentHashes: [UInt64] = []
  ) {
    self.photos = photos
    self.images = []
    self.masks = []
    self.byteBudget = byteBudget
    self.processingPixels = processingPixels
    self.contentHashes = contentHashes
  }

  /// A store of images in memory: photo id i is `images[i]`, and its mask, gray, is `masks[i]`.
  package init(images: [RasterImage], masks: [RasterImage?] = []) {
    self.photos = []
    self.images = images
    self.masks = masks
    self.byteBudget = 0
    self.processingPixels = nil
    self.contentHashes = []
  }

  /// The largest size of at most `maximumPixels` with the aspect of `width` × `height`; never
  /// larger than that.
  package static func size(
    width: Int, height: Int, maximumPixels: Int?
  ) -> (width: Int, height: Int) {
    guard let maximumPixels, width * height > max(1, maximumPixels) else { return (width, height) }
    let scale = (Double(max(1, maximumPixels)) / (Double(width) * Double(height))).squareRoot()
    return (max(1, Int(Double(width) * scale)), max(1, Int(Double(height) * scale)))
  }

  /// The photo in RGB, upright, reduced by area averaging to at most `maximumPixels`.
  ///
  /// The camera of the result is `camera.resized(width:height:)` with the image's size.
  package func image(_ id: ID<Photo>, maximumPixels: Int? = nil) throws -> RasterImage {
    let size = try size(of: id, maximumPixels: maximumPixels)
    if holdsImages {
      return try element(id, of: images).resized(width: size.width, height: size.height)
    }
    let photo = try element(id, of: photos)
    let key = Key(photo: id, width: size.width, height: size.height)
    if let kept = keptImage(key) { return kept }
    let image = try decode(photo, atLeast: size).resized(width: size.width, height: size.height)
    keep(image, key)
    return image
  }

  /// Where the photo shows the object: gray, of the size of `image(id, maximumPixels:)`, 255 on the
  /// object and 0 beside it, between them at a rim that was reduced. Nil where nothing tells.
  package func mask(_ id: ID<Photo>, maximumPixels: Int? = nil) throws -> RasterImage? {
    let size = try size(of: id, maximumPixels: maximumPixels)
    if holdsImages {
      guard masks.indices.contains(id.index) else { return nil }
      return try masks[id.index]?.resized(width: size.width, height: size.height)
    }
    let photo = try element(id, of: photos)
    guard let mask = photo.mask else { return nil }
    let key = Key(photo: id, width: size.width, height: size.height, isMask: true)
    if let kept = keptImage(key) { return kept }
    let image = try decode(mask, of: photo).turned(byOrientation: mask.orientation)
      .resized(width: size.width, height: size.height)
    keep(image, key)
    return image
  }

  /// Whether some photo has a mask.
  package var hasMasks: Bool {
    holdsImages ? masks.contains { $0 != nil } : photos.contains { $0.mask != nil }
  }

  /// The size of `image(id, maximumPixels:)`.
  private func size(
    of id: ID<Photo>, maximumPixels: Int?
  ) throws -> (width: Int, height: Int) {
    if holdsImages {
      let full = try element(id, of: images)
      return Self.size(width: full.width, height: full.height, maximumPixels: maximumPixels)
    }
    let photo = try element(id, of: photos)
    let pixels = [maximumPixels, processingPixels].compactMap { $0 }.min()
    return Self.size(width: photo.width, height: photo.height, maximumPixels: pixels)
  }

  private var holdsImages: Bool { !images.isEmpty || photos.isEmpty }

  /// A number that changes with the photo's content, its mask, and with how they are decoded.
  package func fingerprint(of id: ID<Photo>) throws -> UInt64 {
    var fingerprint = Fingerprint()
    if holdsImages {
      let image = try element(id, of: images)
      fingerprint.add(image.width)
      fingerprint.add(image.pixels)
      if masks.indices.contains(id.index), let mask = masks[id.index] {
        fingerprint.add(mask.pixels)
      }
      return fingerprint.value
    }
    let photo = try element(id, of: photos)
    if contentHashes.indices.contains(id.index) {
      fingerprint.add(contentHashes[id.index])
    } else {
      fingerprint.add(try contents(of: photo))
    }
    for value in [photo.width, photo.height, photo.orientation, processingPixels ?? 0] {
      fingerprint.add(value)
    }
    if let mask = photo.mask {
      fingerprint.add(mask.contentHash)
      fingerprint.add(mask.orientation)
    }
    return fingerprint.value
  }

  /// The camera of `pinholeView` with the same arguments.
  package func pinholeCamera(
    of id: ID<Photo>, in reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> Camera {
    let size = try size(of: id, maximumPixels: maximumPixels)
    let camera = reconstruction.camera(of: id).resized(width: size.width, height: size.height)
    return camera.distortion == .zero
      ? camera : camera.undistortedPinhole(maximumPixels: maximumPixels)
  }

  /// The photo freed from lens distortion, at most `maximumPixels` large.
  ///
  /// Every pixel has a source in the photo: the view is the largest rectangle around the principal
  /// point that the undistorted photo fills, so it may show a little less than the photo. Its focal
  /// length is the photo's, scaled; without distortion it is the whole photo.
  package func pinholeView(
    _ id: ID<Photo>, of reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> PinholeView {
    guard reconstruction.photos.indices.contains(id.index),
      let pose = reconstruction.poses[id.index]
    else { throw KernelError.invalidArgument("photo \(id.index) is not registered") }
    let image = try image(id, maximumPixels: maximumPixels)
    let mask = try mask(id, maximumPixels: maximumPixels)
    let camera = reconstruction.camera(of: id).resized(width: image.width, height: image.height)
    guard camera.distortion != .zero else {
      return PinholeView(
        photo: id, image: image, camera: camera, cameraFromWorld: pose, mask: mask)
    }
    let pinhole = try pinholeCamera(of: id, in: reconstruction, maximumPixels: maximumPixels)
    return PinholeView(
      photo: id, image: try image.undistorted(from: camera, to: pinhole), camera: pinhole,
      cameraFromWorld: pose, mask: try mask?.undistorted(from: camera, to: pinhole))
  }

  /// The mask of `pinholeView` with the same arguments.
  package func pinholeMask(
    _ id: ID<Photo>, of reconstruction: Reconstruction, maximumPixels: Int
  ) throws -> RasterImage? {
    guard let mask = try mask(id, maximumPixels: maximumPixels) else { return nil }
    let camera = reconstruction.camera(of: id).resized(width: mask.width, height: mask.height)
    guard camera.distortion != .zero else { return mask }
    let pinhole = try pinholeCamera(of: id, in: reconstruction, maximumPixels: maximumPixels)
    return try mask.undistorted(from: camera, to: pinhole)
  }

  private func element<Element>(_ id: ID<Photo>, of array: [Element]) throws -> Element {
    guard array.indices.contains(id.index) else {
      throw KernelError.invalidArgument("there is no photo \(id.index)")
    }
    return array[id.index]
  }

  /// The upright photo, at a half, a quarter or an eighth of its sides where that is still at least
  /// `size` and costs less.
  private func decode(_ photo: Photo, atLeast size: (width: Int, height: Int)) throws -> RasterImage
  {
    // Only sizes without remainder: pixels at the border must stand for as much as all others.
    let reduction =
      ImageCodec.reductions.last {
        photo.width % $0 == 0 && photo.height % $0 == 0 && photo.width / $0 >= size.width
          && photo.height / $0 >= size.height
      } ?? 1
    let bytes = try contents(of: photo)
    return try naming(photo) {
      let image = try ImageCodec.decode(bytes, reducedBy: reduction)
        .turned(byOrientation: photo.orientation)
      let isWhole = image.width == photo.width && image.height == photo.height
      let isReduced =
        image.width == photo.width / reduction && image.height == photo.height / reduction
      guard isWhole || isReduced else {
        throw ImageError.unreadable("it has changed during the run")
      }
      return image
    }
  }

  /// The mask as it is stored.
  private func decode(_ mask: PhotoMask, of photo: Photo) throws -> RasterImage {
    do throws(ImageError) {
      let bytes = try ImageCodec.contents(of: mask.file ?? photo.url)
      let image = try mask.file == nil ? MaskImage.alpha(bytes) : MaskImage.decode(bytes)
      guard let image else { throw .unreadable("it has changed during the run") }
      return image
    } catch {
      throw PhotoReadError(name: (mask.file ?? photo.url).lastPathComponent, reason: error)
    }
  }

  private func contents(of photo: Photo) throws -> [UInt8] {
    try naming(photo) { try ImageCodec.contents(of: photo.url) }
  }

  private func naming<Value>(_ photo: Photo, _ body: () throws -> Value) throws -> Value {
    do {
      return try body()
    } catch let error as ImageError {
      throw PhotoReadError(name: photo.name, reason: error)
    }
  }

  private func keptImage(_ key: Key) -> RasterImage? {
    cache.withLock { cache in
      guard let entry = cache.images[key] else { return nil }
      cache.clock += 1
      cache.images[key]?.lastUse = cache.clock
      return entry.image
    }
  }

  private func keep(_ image: RasterImage, _ key: Key) {
    let size = image.pixels.count
    guard size <= byteBudget else { return }
    cache.withLock { cache in
      guard cache.images[key] == nil else { return }
      while cache.byteCount + size > byteBudget,
        let oldest = cache.images.min(by: { $0.value.lastUse < $1.value.lastUse })
      {
        cache.byteCount -= oldest.value.image.pixels.count
        cache.images[oldest.key] = nil
      }
      cache.clock += 1
      cache.images[key] = (image, cache.clock)
      cache.byteCount += size
    }
  }
}

/// A photo that could be read when the run began and can't be now.
package struct PhotoReadError: LocalizedError, Sendable {
  package var name: String
  package var reason: ImageError

  package var errorDescription: String? {
    "\(name) can't be used: \(reason.errorDescription ?? "unknown reason")."
  }
}
