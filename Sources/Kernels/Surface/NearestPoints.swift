import CKernels

/// The k nearest points of a set for each query.
package struct NearestPoints: Sendable {
  /// Number of neighbors that are returned per query.
  package let neighbors: Int
  /// `neighbors` indices per query, nearest first; −1 if there are fewer.
  package let indices: [Int32]
  /// The distances corresponding to `indices`; infinite if there are fewer.
  package let distances: [Float]

  /// Finds the nearest `neighbors` of `points` within `maximumDistance` of every query.
  package init(
    of queries: [SIMD3<Float>], in points: [SIMD3<Float>], neighbors: Int = 1,
    maximumDistance: Double = .infinity, _ control: KernelControl
  ) throws {
    let width = max(1, neighbors)
    var indices = [Int32](repeating: -1, count: queries.count * width)
    var distances = [Float](repeating: .infinity, count: queries.count * width)
    if !queries.isEmpty {
      var options = ck_nearest_options(
        neighbors: Int32(width), maximum_distance: maximumDistance)
      try withKernel(control) { control in
        withSpans(points, queries) { points, queries in
          ck_nearest_points(points, queries, &options, control, &indices, &distances)
        }
      }
    }
    self.neighbors = width
    self.indices = indices
    self.distances = distances
  }
}
