import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Photos in files.
struct PhotoFiles: PhotoPixels {
  let photos: [Photo]
  /// By photo ID; empty if unknown, in which case files are read for fingerprints.
  let contentHashes: [UInt64]

  var hasMasks: Bool { photos.contains { $0.mask != nil } }
  var byteCount: Int { photos.reduce(0) { $0 + 3 * $1.width * $1.height } }

  func size(of id: ID<Photo>) throws -> (width: Int, height: Int) {
    let photo = try photo(id)
    return (photo.width, photo.height)
  }

  /// Only exact divisors of both sides, so that border pixels have the same weight as all others.
  func reduction(of id: ID<Photo>, atLeast size: (width: Int, height: Int)) throws -> Int {
    let photo = try photo(id)
    return ImageCodec.reductions.last {
      photo.width % $0 == 0 && photo.height % $0 == 0 && photo.width / $0 >= size.width
        && photo.height / $0 >= size.height
    } ?? 1
  }

  func decoded(_ id: ID<Photo>, reducedBy reduction: Int) throws -> RasterImage {
    let photo = try photo(id)
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

  func mask(of id: ID<Photo>) throws -> RasterImage? {
    let photo = try photo(id)
    guard let mask = photo.mask else { return nil }
    return try decoded(mask, of: photo).turned(byOrientation: mask.orientation)
  }

  func hasMask(_ id: ID<Photo>) -> Bool {
    photos.indices.contains(id.index) && photos[id.index].mask != nil
  }

  func fingerprint(of id: ID<Photo>) throws -> UInt64 {
    let photo = try photo(id)
    var fingerprint = Fingerprint()
    if contentHashes.indices.contains(id.index) {
      fingerprint.add(contentHashes[id.index])
    } else {
      fingerprint.add(try contents(of: photo))
    }
    for value in [photo.width, photo.height, photo.orientation] { fingerprint.add(value) }
    if let mask = photo.mask {
      fingerprint.add(mask.contentHash)
      fingerprint.add(mask.orientation)
    }
    return fingerprint.value
  }

  private func photo(_ id: ID<Photo>) throws -> Photo {
    guard photos.indices.contains(id.index) else {
      throw KernelError.invalidArgument("there is no photo \(id.index)")
    }
    return photos[id.index]
  }

  /// The mask as stored, not turned upright.
  private func decoded(_ mask: PhotoMask, of photo: Photo) throws -> RasterImage {
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

  /// Calls `body`, and adds the photo's name to image errors.
  private func naming<Value>(_ photo: Photo, _ body: () throws -> Value) throws -> Value {
    do {
      return try body()
    } catch let error as ImageError {
      throw PhotoReadError(name: photo.name, reason: error)
    }
  }
}
