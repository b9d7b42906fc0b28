import Foundation
import Kernels
import SceneModel
import Synchronization

/// Decodes photos on demand and keeps the latest within a byte budget.
///
/// Thread-safe. What it returns depends on the arguments only, never on what is kept.
package final class ImageStore: Sendable {
  private struct Key: Hashable {
    var photo: ID<Photo>
    var width: Int
    var height: Int
  }

  private struct Cache {
    var images: [Key: (image: RasterImage, lastUse: Int)] = [:]
    var byteCount = 0
    var clock = 0
  }

  private let photos: [Photo]
  private let images: [RasterImage]
  private let byteBudget: Int
  private let processingPixels: Int?
  private let cache = Mutex(Cache())

  /// `byteBudget` bounds the images that are kept between calls, not those a caller holds. No image
  /// is larger than `processingPixels`.
  package init(photos: [Photo], byteBudget: Int = 1 << 30, processingPixels: Int? = nil) {
    self.photos = photos
    self.images = []
    self.byteBudget = byteBudget
    self.processingPixels = processingPixels
  }

  /// A store of images in memory: photo id i is `images[i]`.
  package init(images: [RasterImage]) {
    self.photos = []
    self.images = images
    self.byteBudget = 0
    self.processingPixels = nil
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
    if !images.isEmpty || photos.isEmpty {
      let full = try element(id, of: images)
      let size = Self.size(width: full.width, height: full.height, maximumPixels: maximumPixels)
      return try full.resized(width: size.width, height: size.height)
    }
    let photo = try element(id, of: photos)
    let pixels = [maximumPixels, processingPixels].compactMap { $0 }.min()
    let size = Self.size(width: photo.width, height: photo.height, maximumPixels: pixels)
    let key = Key(photo: id, width: size.width, height: size.height)
    if let kept = keptImage(key) { return kept }
    let image = try decode(photo).resized(width: size.width, height: size.height)
    keep(image, key)
    return image
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
    let camera = reconstruction.camera(of: id).resized(width: image.width, height: image.height)
    guard camera.distortion != .zero else {
      return PinholeView(photo: id, image: image, camera: camera, cameraFromWorld: pose)
    }
    let pinhole = camera.undistortedPinhole(maximumPixels: maximumPixels)
    return PinholeView(
      photo: id, image: try image.undistorted(from: camera, to: pinhole), camera: pinhole,
      cameraFromWorld: pose)
  }

  private func element<Element>(_ id: ID<Photo>, of array: [Element]) throws -> Element {
    guard array.indices.contains(id.index) else {
      throw KernelError.invalidArgument("there is no photo \(id.index)")
    }
    return array[id.index]
  }

  private func decode(_ photo: Photo) throws -> RasterImage {
    do {
      let image = try ImageCodec.decode(ImageCodec.contents(of: photo.url))
        .turned(byOrientation: photo.orientation)
      guard image.width == photo.width, image.height == photo.height else {
        throw ImageError.unreadable("it has changed during the run")
      }
      return image
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
