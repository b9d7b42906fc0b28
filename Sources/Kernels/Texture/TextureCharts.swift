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
  /// fold them.
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

/// The placement of a packed chart: `texel = scale · R · plane + offset`, y down.
package struct ChartPlacement: Hashable, Sendable {
  /// Texels per unit of length of the chart's plane.
  package var scale: Float
  /// Number of rotations by 90° from x to y.
  package var quarterTurns: Int
  /// Texels.
  package var offset: SIMD2<Float>
  /// Index of the atlas.
  package var atlas: Int

  /// The texel position of a point of the chart's plane.
  package func texel(_ p: SIMD2<Float>) -> SIMD2<Float> {
    let q = scale * p
    let turned: SIMD2<Float> =
      switch quarterTurns & 3 {
      case 1: [-q.y, q.x]
      case 2: [-q.x, -q.y]
      case 3: [q.y, -q.x]
      default: q
      }
    return turned + offset
  }
}

/// Packs charts by their shape into square atlases at the largest common scale.
package struct ChartPacking: Hashable, Codable, Sendable {
  /// Side of the atlases in texels.
  package var side: Int
  /// Maximum number of atlases.
  package var atlasCount: Int
  /// Empty texels between charts; half as many along the border.
  package var padding: Int
  /// Maximum texels per unit of length at density 1.
  package var maximumScale: Float

  package init(side: Int, atlasCount: Int = 1, padding: Int, maximumScale: Float) {
    self.side = side
    self.atlasCount = atlasCount
    self.padding = padding
    self.maximumScale = maximumScale
  }

  /// The placement of each chart. Throws `KernelError.degenerate` if they do not fit. `corners` are
  /// the plane coordinates of each triangle's three corners; `density` scales the charts relative
  /// to each other.
  package func run(
    corners: [SIMD2<Float>], charts: [Int32], density: [Float], _ control: KernelControl
  ) throws -> [ChartPlacement] {
    guard corners.count == 3 * charts.count else {
      throw KernelError.invalidArgument("corners and triangles differ in number")
    }
    var raw = [ck_chart_placement](repeating: ck_chart_placement(), count: density.count)
    var options = ck_pack_options(
      side: Int32(clamping: side), atlas_count: Int32(clamping: atlasCount),
      padding: Int32(clamping: padding), maximum_scale: maximumScale)
    try withKernel(control) { control in
      corners.withUnsafeFloats { corners in
        ck_pack_charts(
          corners, charts, charts.count, density, density.count, &options, control, &raw)
      }
    }
    return raw.map {
      ChartPlacement(
        scale: $0.scale, quarterTurns: Int($0.quarter_turns), offset: [$0.offset.0, $0.offset.1],
        atlas: Int($0.atlas))
    }
  }
}
