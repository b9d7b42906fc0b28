import Kernels
import SceneModel

/// Where the triangles are in the texture.
struct AtlasLayout: Sendable {
  /// Side of the square texture in texels.
  var side: Int
  /// Texel coordinates of each triangle's three corners; origin top left, y down.
  var corners: [SIMD2<Float>]
  /// Texels for a photo's pixel, along a line.
  var magnification: Float
}

/// Packs all charts into one square texture.
struct AtlasPacking: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Upper bound of the texture's side.
    var maximumSide = 4096
    /// Texels a photo's pixel that are still of use; more would only take space.
    var maximumMagnification: Float = 2
  }

  var options = Options()

  func run(_ map: ChartMap, _ context: StageContext) throws -> AtlasLayout {
    let side = usefulSide(map)
    // Pixels have y down, the charts' planes y up.
    let corners = map.corners.map { SIMD2($0.x, -$0.y) }
    let packing = ChartPacking(
      side: side, padding: max(2, side / 1024), maximumScale: options.maximumMagnification)
    let placements = try packing.run(
      corners: corners, charts: map.charts, density: map.densities, context.control)
    let texels = corners.indices.map { index in
      placements[Int(map.charts[index / 3])].texel(corners[index])
    }
    let magnification =
      placements.isEmpty || map.densities[0] <= 0 ? 1 : placements[0].scale / map.densities[0]
    return AtlasLayout(side: side, corners: texels, magnification: magnification)
  }

  /// The side, halved while half of it would hold everything at the useful resolution.
  private func usefulSide(_ map: ChartMap) -> Int {
    var area: Float = 0
    for face in map.charts.indices {
      let (a, b, c) = (map.corners[3 * face], map.corners[3 * face + 1], map.corners[3 * face + 2])
      let scale = map.densities[Int(map.charts[face])] * options.maximumMagnification
      area += abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2 * scale * scale
    }
    var side = options.maximumSide
    while side >= 512, area < 0.45 * Float(side / 2) * Float(side / 2) { side /= 2 }
    return side
  }
}
