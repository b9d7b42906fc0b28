import Foundation
import Kernels
import SceneModel

/// Decodes photos on demand and keeps images within a byte budget.
///
/// Thread-safe. Results depend on the arguments only, never on the cached images.
package final class ImageStore: Sendable {
  private let source: any PhotoPixels
  private let processingPixels: Int?
  private let usesMasks: Bool
  /// Distinguishes the masks of stores that share decoded images.
  private let maskSet: UUID
  private let cache: ImageCache
  /// The photos at full size, if all of them fit into the budget: then each is decoded at full size
  /// once. `cache` has what remains of the budget.
  private let wholePhotos: ImageCache?
  /// Every photo is decoded for an image of this number of pixels, or of more.
  private let decodedPixels: Int
  private let decodes: Locked<Int>

  /// `byteBudget` bounds the images that are kept between calls, not those a caller holds. No image
  /// is larger than `processingPixels`.
  package init(
    _ source: any PhotoPixels, byteBudget: Int = 1 << 30, processingPixels: Int? = nil
  ) {
    self.source = source
    self.processingPixels = processingPixels
    usesMasks = true
    maskSet = UUID()
    let wholeBytes = source.byteCount <= byteBudget ? source.byteCount : 0
    cache = ImageCache(byteBudget: byteBudget - wholeBytes)
    wholePhotos = wholeBytes > 0 ? ImageCache(byteBudget: wholeBytes) : nil
    decodedPixels = 0
    decodes = Locked(0)
  }

  /// A store with the photos and the decoded images of another one.
  private init(
    sharing other: ImageStore, source: (any PhotoPixels)? = nil, usesMasks: Bool,
    decodedPixels: Int
  ) {
    self.source = source ?? other.source
    maskSet = source == nil ? other.maskSet : UUID()
    processingPixels = other.processingPixels
    self.usesMasks = usesMasks
    cache = other.cache
    wholePhotos = other.wholePhotos
    self.decodedPixels = decodedPixels
    decodes = other.decodes
  }

  /// The photos of another store without their masks; the two share their decoded images.
  package convenience init(withoutMasksOf other: ImageStore) {
    self.init(sharing: other, usesMasks: false, decodedPixels: other.decodedPixels)
  }

  /// A store of the same photos with other masks; `other` has none. The two share their decoded
  /// images.
  convenience init(masked photos: [Photo], contentHashes: [UInt64], sharing other: ImageStore) {
    self.init(
      sharing: other, source: PhotoFiles(photos: photos, contentHashes: contentHashes),
      usesMasks: true, decodedPixels: other.decodedPixels)
  }

  /// The same photos for a stage that needs them in several sizes, up to `maximumPixels`: one
  /// decoding serves all sizes.
  func decodingOnce(forSizesUpTo maximumPixels: Int) -> ImageStore {
    ImageStore(sharing: self, usesMasks: usesMasks, decodedPixels: maximumPixels)
  }

  /// Marks the beginning of a stage: its images may displace those of earlier stages.
  func startStage() {
    cache.startStage()
    wholePhotos?.startStage()
  }

  /// A store of photos in files. `contentHashes`, by photo id, avoid rereading files if they are
  /// known.
  package convenience init(
    photos: [Photo], byteBudget: Int = 1 << 30, processingPixels: Int? = nil,
    contentHashes: [UInt64] = []
  ) {
    self.init(
      PhotoFiles(photos: photos, contentHashes: contentHashes), byteBudget: byteBudget,
      processingPixels: processingPixels)
  }

  /// The largest size of at most `maximumPixels` with the aspect ratio of `width` × `height`; never
  /// larger than that.
  package static func size(
    width: Int, height: Int, maximumPixels: Int?
  ) -> (width: Int, height: Int) {
    guard let maximumPixels, width * height > max(1, maximumPixels) else { return (width, height) }
    let scale = (Double(max(1, maximumPixels)) / (Double(width) * Double(height))).squareRoot()
    return (max(1, Int(Double(width) * scale)), max(1, Int(Double(height) * scale)))
  }

  /// The number of photos decoded so far; a photo counts each time it is decoded.
  package var decodeCount: Int { decodes.withLock { $0 } }

  /// The photo in RGB, upright, reduced by area averaging to at most `maximumPixels`.
  ///
  /// The camera of the result is `camera.resized(width:height:)` with the image's size. What is
  /// needed once should not be kept: it would displace what is needed more often.
  package func image(
    _ id: ID<Photo>, maximumPixels: Int? = nil, isKept: Bool = true
  ) throws -> RasterImage {
    let size = try size(of: id, maximumPixels: maximumPixels)
    let shared = try self.size(of: id, maximumPixels: decodedPixels)
    let reduction = try source.reduction(
      of: id, atLeast: (max(size.width, shared.width), max(size.height, shared.height)))
    let content = ImageCache.Content.resized(
      width: size.width, height: size.height, reduction: reduction)
    if let kept = cache.image(content, of: id) { return kept }
    let decoded = try decoded(id, reducedBy: reduction, for: size)
    guard decoded.width != size.width || decoded.height != size.height else { return decoded }
    let image = try decoded.resized(width: size.width, height: size.height)
    if decodedPixels == 0, isKept { cache.keep(image, content, of: id) }
    return image
  }

  /// The photo as decoded for an image of a given size. It is cached if it has that size, if other
  /// sizes may be needed, or if all photos fit into the budget at full size.
  private func decoded(
    _ id: ID<Photo>, reducedBy reduction: Int, for size: (width: Int, height: Int)
  ) throws -> RasterImage {
    let content = ImageCache.Content.decoded(reduction: reduction)
    let cache = reduction == 1 ? wholePhotos ?? cache : cache
    if let kept = cache.image(content, of: id) { return kept }
    let image = try source.decoded(id, reducedBy: reduction)
    decodes.withLock { $0 += 1 }
    let isResult = image.width == size.width && image.height == size.height
    if isResult || decodedPixels > 0 || cache === wholePhotos { cache.keep(image, content, of: id) }
    return image
  }

  /// The mask of the object: gray, of the size of `image(id, maximumPixels:)`, 255 on the object
  /// and 0 elsewhere, with intermediate values at boundaries after downsampling. Nil without a
  /// mask.
  package func mask(_ id: ID<Photo>, maximumPixels: Int? = nil) throws -> RasterImage? {
    let size = try size(of: id, maximumPixels: maximumPixels)
    guard usesMasks else { return nil }
    let content = ImageCache.Content.mask(
      width: size.width, height: size.height, set: maskSet)
    if let kept = cache.image(content, of: id) { return kept }
    guard let mask = try source.mask(of: id) else { return nil }
    let image = try mask.resized(width: size.width, height: size.height)
    cache.keep(image, content, of: id)
    return image
  }

  /// Whether a photo has a mask.
  func hasMask(_ id: ID<Photo>) -> Bool { usesMasks && source.hasMask(id) }

  /// Whether some photo has a mask.
  package var hasMasks: Bool { usesMasks && source.hasMasks }

  /// The size of `image(id, maximumPixels:)`.
  func size(of id: ID<Photo>, maximumPixels: Int?) throws -> (width: Int, height: Int) {
    let full = try source.size(of: id)
    let pixels = [maximumPixels, processingPixels].compactMap { $0 }.min()
    return Self.size(width: full.width, height: full.height, maximumPixels: pixels)
  }

  /// A number that changes with the photo's content, with its mask and with how they are decoded.
  package func fingerprint(of id: ID<Photo>) throws -> UInt64 {
    var fingerprint = Fingerprint()
    fingerprint.add(try source.fingerprint(of: id))
    fingerprint.add(processingPixels ?? 0)
    return fingerprint.value
  }
}
