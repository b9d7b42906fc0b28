import Kernels
import SceneModel

@testable import Pipeline

/// Photos and masks in memory, by photo id.
struct ImagesInMemory: PhotoPixels {
  var images: [RasterImage]
  /// Gray; empty, or one entry for each image.
  var masks: [RasterImage?] = []

  var hasMasks: Bool { masks.contains { $0 != nil } }
  var byteCount: Int { images.reduce(0) { $0 + $1.pixels.count } }

  func size(of id: ID<Photo>) throws -> (width: Int, height: Int) {
    let image = try decoded(id, reducedBy: 1)
    return (image.width, image.height)
  }

  func reduction(of id: ID<Photo>, atLeast size: (width: Int, height: Int)) -> Int { 1 }

  func decoded(_ id: ID<Photo>, reducedBy reduction: Int) throws -> RasterImage {
    guard images.indices.contains(id.index) else {
      throw KernelError.invalidArgument("there is no photo \(id.index)")
    }
    return images[id.index]
  }

  func mask(of id: ID<Photo>) -> RasterImage? {
    masks.indices.contains(id.index) ? masks[id.index] : nil
  }

  func hasMask(_ id: ID<Photo>) -> Bool { mask(of: id) != nil }

  func fingerprint(of id: ID<Photo>) throws -> UInt64 {
    let image = try decoded(id, reducedBy: 1)
    var fingerprint = Fingerprint()
    fingerprint.add(image.width)
    fingerprint.add(image.pixels)
    if let mask = mask(of: id) { fingerprint.add(mask.pixels) }
    return fingerprint.value
  }
}

extension ImageStore {
  /// A store of images in memory that keeps no copies.
  convenience init(images: [RasterImage], masks: [RasterImage?] = []) {
    self.init(ImagesInMemory(images: images, masks: masks), byteBudget: 0)
  }
}
