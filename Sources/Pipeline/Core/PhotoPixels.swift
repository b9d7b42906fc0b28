import SceneModel

/// The pixels of a set of photos and of their masks: files in a run, images in memory in tests.
package protocol PhotoPixels: Sendable {
  /// Size of the upright photo in pixels; throws if there is no such photo.
  func size(of id: ID<Photo>) throws -> (width: Int, height: Int)

  /// The largest divisor of both sides that `decoded` can apply for an image of at least `size`.
  func reduction(of id: ID<Photo>, atLeast size: (width: Int, height: Int)) throws -> Int

  /// The upright photo in RGB with its sides divided by `reduction`, or at full size if the format
  /// can't be reduced.
  func decoded(_ id: ID<Photo>, reducedBy reduction: Int) throws -> RasterImage

  /// The upright mask at full size: gray, 255 on the object, 0 elsewhere. Nil if the photo has
  /// none.
  func mask(of id: ID<Photo>) throws -> RasterImage?

  /// Whether a photo has a mask.
  func hasMask(_ id: ID<Photo>) -> Bool

  /// Whether some photo has a mask.
  var hasMasks: Bool { get }

  /// A number that changes with the content of a photo, with its mask and with how they are
  /// decoded.
  func fingerprint(of id: ID<Photo>) throws -> UInt64

  /// The total size of all photos in bytes, at full size in RGB.
  var byteCount: Int { get }
}
