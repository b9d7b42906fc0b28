import CKernels
import SceneModel

/// Groups triangles into charts that can be flattened without folding.
///
/// Hierarchical face clustering (Garland, Willmott and Heckbert, I3D 2001) on cones of normals,
/// with boundaries that are then shortened level by level.
package struct ChartClustering: Hashable, Codable, Sendable {
  /// Maximum half-angle of the cone that contains the normals of a chart, in radians.
  package var maximumAngle: Float = 1
  /// Charts with a smaller fraction of the surface area are merged with a neighbor if that does not
  /// fold them. Chosen.
  package var minimumShare: Float = 2e-4

  package init() {}

  /// The chart of each triangle, numbered without gaps from 0, and the unit projection direction of
  /// each chart.
  package func run(
    _ mesh: Mesh, _ control: KernelControl
  ) throws -> (charts: [Int32], axes: [SIMD3<Float>]) {
    var charts = [Int32](repeating: 0, count: mesh.triangles.count)
    var axes = [Float](repeating: 0, count: 3 * mesh.triangles.count)
    var count = 0
    var options = ck_chart_options(
      maximum_angle: maximumAngle, minimum_share: minimumShare)
    try withKernel(control) { control in
      mesh.withKernelValue { ck_cluster_faces($0, &options, control, &charts, &axes, &count) }
    }
    return (charts, (0..<count).map { SIMD3(axes[3 * $0], axes[3 * $0 + 1], axes[3 * $0 + 2]) })
  }
}
