import Kernels
import SceneModel

/// Where the triangles are in the textures.
struct AtlasLayout: Sendable {
  /// Side of the square textures in texels.
  var side: Int
  /// The texture of each triangle; each of `0..<count` has some.
  var atlases: [Int]
  var count: Int
  /// Texel coordinates of each triangle's three corners; origin top left, y down.
  var corners: [SIMD2<Float>]
  /// Texels for a photo's pixel, along a line.
  var magnification: Float

  /// The triangles of one texture, ascending.
  func faces(in atlas: Int) -> [Int] { atlases.indices.filter { atlases[$0] == atlas } }

  /// The corners as one texture has them: triangles of others have no area there.
  func corners(in atlas: Int) -> [SIMD2<Float>] {
    guard count > 1 else { return corners }
    return corners.indices.map { atlases[$0 / 3] == atlas ? corners[$0] : .zero }
  }

  /// The same layout with textures of another size.
  func scaled(toSide side: Int) -> AtlasLayout {
    var result = self
    let factor = Float(side) / Float(self.side)
    result.side = side
    result.magnification *= factor
    result.corners = corners.map { $0 * factor }
    return result
  }
}

/// Packs all charts into one square texture, or into several where the photos show more than one
/// holds and more are allowed.
struct AtlasPacking: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Upper bound of the textures' side.
    var maximumSide = 4096
    var maximumAtlases = 1
    /// Texels for a photo's pixel, along a line, that keep all of its detail. The smallest texture
    /// that has as many is taken, and filled; beyond its bounds there are more textures.
    var sufficientMagnification: Float = 1.5
    /// More would show nothing but the interpolation.
    var maximumMagnification: Float = 4
    /// The share of a texture that charts may be expected to fill.
    var expectedUsage: Float = 0.7
  }

  var options = Options()

  func run(_ map: ChartMap, _ context: StageContext) throws -> AtlasLayout {
    let (side, count) = usefulSize(map)
    // Pixels have y down, the charts' planes y up.
    let corners = map.corners.map { SIMD2($0.x, -$0.y) }
    let packing = ChartPacking(
      side: side, atlasCount: count, padding: max(2, side / 1024),
      maximumScale: options.maximumMagnification)
    let placements = try packing.run(
      corners: corners, charts: map.charts, density: map.densities, context.control)
    let texels = corners.indices.map { index in
      placements[Int(map.charts[index / 3])].texel(corners[index])
    }
    let magnification =
      placements.isEmpty || map.densities[0] <= 0 ? 1 : placements[0].scale / map.densities[0]
    let layout = AtlasLayout(
      side: side, atlases: map.charts.map { placements[Int($0)].atlas },
      count: 1 + (placements.map(\.atlas).max() ?? 0), corners: texels,
      magnification: magnification)
    note(layout, context.notes)
    return layout
  }

  /// The side, halved while half of it holds all detail, and how many textures hold it.
  private func usefulSize(_ map: ChartMap) -> (side: Int, count: Int) {
    var area: Float = 0
    for face in map.charts.indices {
      let (a, b, c) = (map.corners[3 * face], map.corners[3 * face + 1], map.corners[3 * face + 2])
      let scale = map.densities[Int(map.charts[face])] * options.sufficientMagnification
      area += abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2 * scale * scale
    }
    func capacity(_ side: Int) -> Float { options.expectedUsage * Float(side) * Float(side) }
    var side = options.maximumSide
    while side >= 512, area < capacity(side / 2) { side /= 2 }
    let needed = (area / capacity(side)).rounded(.up)
    return (side, max(1, Int(min(needed, Float(options.maximumAtlases)))))
  }

  /// Says how large the texture is, and why not larger.
  private func note(_ layout: AtlasLayout, _ notes: StageNotes) {
    notes.count("textureSide", Double(layout.side))
    notes.count("textures", Double(layout.count))
    notes.count("texelsPerPixel", Double(layout.magnification))
    let isFilled =
      layout.side == options.maximumSide && layout.count == options.maximumAtlases
    let texels = Double((100 * layout.magnification).rounded()) / 100
    func name(_ count: Int, _ side: Int) -> String { "\(count == 1 ? "" : "\(count) × ")\(side)²" }
    if !isFilled {
      notes.tell(
        "The texture is \(name(layout.count, layout.side)), not "
          + "\(name(options.maximumAtlases, options.maximumSide)) as the level allows: it has "
          + "\(texels) texels a pixel of the photos, along a line, and they show no more.")
    } else if layout.magnification < 1 {
      notes.tell(
        "The photos show more than the level's texture holds: it has \(texels) texels a pixel of "
          + "the photos, along a line.")
    }
  }
}
