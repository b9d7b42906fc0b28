import SceneModel

/// The size of a set of photos, which determines the duration of a run.
package struct PhotoTotals: Hashable, Sendable {
  package var count: Int
  /// Sum over all photos.
  package var megapixels: Double
  /// Number of photos with masks.
  package var masked = 0

  package init(count: Int, megapixels: Double) {
    (self.count, self.megapixels) = (count, megapixels)
  }

  /// Assumes a common size, 6 megapixels, for photos that have not been read yet.
  package init(count: Int) { self.init(count: count, megapixels: 6 * Double(count)) }

  package init(_ photos: [Photo]) {
    self.init(
      count: photos.count,
      megapixels: photos.reduce(0) { $0 + Double($1.width * $1.height) } / 1e6)
    masked = photos.count { $0.mask != nil }
  }
}
