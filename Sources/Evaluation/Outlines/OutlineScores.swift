import Foundation

/// How well outlines agree with masks, as shares of the masks' areas.
package struct OutlineScores: Codable, Hashable, Sendable {
  package struct Entry: Codable, Hashable, Sendable {
    package var name: String
    /// Intersection over union.
    package var intersectionOverUnion: Double
    /// What is outside of the mask, and what the mask has in addition.
    package var outside: Double
    package var missing: Double
  }

  /// In the order of their names.
  package var photos: [Entry]
  /// Means over the photos; the least IoU is that of the photo `worst`.
  package var intersectionOverUnion: Double
  package var medianIntersectionOverUnion: Double
  package var minimumIntersectionOverUnion: Double
  package var worst: String
  package var outside: Double
  package var missing: Double

  /// Nil without photos.
  init?(_ entries: [Entry]) {
    photos = entries.sorted { $0.name < $1.name }
    let sorted = photos.map(\.intersectionOverUnion).sorted()
    guard let minimum = sorted.first,
      let worst = photos.first(where: { $0.intersectionOverUnion == minimum })
    else { return nil }
    func mean(_ values: [Double]) -> Double { values.reduce(0, +) / Double(values.count) }
    intersectionOverUnion = mean(sorted)
    medianIntersectionOverUnion = sorted.median
    (minimumIntersectionOverUnion, self.worst) = (minimum, worst.name)
    outside = mean(photos.map(\.outside))
    missing = mean(photos.map(\.missing))
  }
}
