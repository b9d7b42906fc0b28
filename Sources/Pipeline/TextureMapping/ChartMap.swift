/// The surface cut into flattened charts.
struct ChartMap: Sendable {
  /// The chart index of each triangle.
  var charts: [Int32]
  /// Plane coordinates, in world units, of each triangle's three corners; counterclockwise, y up.
  var corners: [SIMD2<Float>]
  /// Photo pixels per world unit for each chart: the resolution that its texture requires.
  var densities: [Float]
}
