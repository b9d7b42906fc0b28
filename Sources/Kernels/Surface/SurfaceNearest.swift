import CKernels
import SceneModel

/// The nearest points of a set for each of many queries.
package struct NearestPoints: Sendable {
  /// Neighbours of a query.
  package let neighbours: Int
  /// `neighbours` indices a query, the nearest first; −1 where there are fewer.
  package let indices: [Int32]
  /// The distances that go with `indices`; infinite where there are fewer.
  package let distances: [Float]

  /// Finds the nearest `neighbours` of `points` within `maximumDistance` of every query.
  package init(
    of queries: [SIMD3<Float>], in points: [SIMD3<Float>], neighbours: Int = 1,
    maximumDistance: Double = .infinity, _ control: KernelControl
  ) throws {
    let width = max(1, neighbours)
    var indices = [Int32](repeating: -1, count: queries.count * width)
    var distances = [Float](repeating: .infinity, count: queries.count * width)
    if !queries.isEmpty {
      let stride = MemoryLayout<SIMD3<Float>>.stride
      try withKernel(control) { control in
        points.withUnsafeBytes { points in
          queries.withUnsafeBytes { queries in
            ck_nearest_points(
              points.floats, stride, points.count / stride, queries.floats, stride,
              queries.count / stride, Int32(width), maximumDistance, control, &indices,
              &distances)
          }
        }
      }
    }
    self.neighbours = width
    self.indices = indices
    self.distances = distances
  }
}
