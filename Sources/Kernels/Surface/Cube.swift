/// A cube along the axes of a frame.
package struct Cube: Hashable, Codable, Sendable {
  /// The lowest corner.
  package var origin: SIMD3<Double>
  package var side: Double

  package init(origin: SIMD3<Double>, side: Double) {
    (self.origin, self.side) = (origin, side)
  }
}
