import CKernels

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
