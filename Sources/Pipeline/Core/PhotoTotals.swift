import SceneModel

/// The size of a set of photos: what the duration of a run depends on.
package struct PhotoTotals: Hashable, Sendable {
  package var count: Int
  /// Sum over all photos.
  package var megapixels: Double

  package init(count: Int, megapixels: Double) {
    (self.count, self.megapixels) = (count, megapixels)
  }

  /// Photos of a common size, 6 megapixels: for photos that are not read yet.
  package init(count: Int) { self.init(count: count, megapixels: 6 * Double(count)) }

  package init(_ photos: [Photo]) {
    self.init(
      count: photos.count,
      megapixels: photos.reduce(0) { $0 + Double($1.width * $1.height) } / 1e6)
  }
}
