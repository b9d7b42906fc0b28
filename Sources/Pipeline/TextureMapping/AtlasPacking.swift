import Kernels

/// Packs all charts into one square texture, or into several if one can't hold the photos' detail
/// and more are allowed.
struct AtlasPacking: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum texture side in texels. Chosen: `DetailSpecification` sets that of the detail level.
    var maximumSide = 4096
    /// Maximum number of textures. Chosen: as above.
    var maximumAtlases = 1
    /// A texture with fewer texels per side is not halved. Chosen.
    var minimumHalvedSide = 512
    /// Padding between charts as one in this number of a texture's side, and its minimum in texels.
    /// Chosen.
    var paddingDivisor = 1024
    var minimumPadding = 2
    /// Texels per photo pixel, linear, that preserve all detail. The smallest texture size that
    /// provides it is chosen and filled; beyond `maximumSide` further textures are added. Chosen.
    var sufficientMagnification: Float = 1.5
    /// Upper bound of the linear magnification; more would only store interpolated values. Chosen.
    var maximumMagnification: Float = 4
    /// Share of a texture that charts are expected to fill. Chosen: textures are filled to 75 to 84
    /// % (docs/experiments/2026-11-models.md, Detail levels).
    var expectedUsage: Float = 0.7
  }

  var options = Options()

  /// Packs the charts; throws if the run is canceled.
  func run(_ map: ChartMap, _ context: StageContext) throws -> AtlasLayout {
    let (side, count) = usefulSize(map)
    // Pixel y points down, chart-plane y points up.
    let corners = map.corners.map { SIMD2($0.x, -$0.y) }
    let packing = ChartPacking(
      side: side, atlasCount: count,
      padding: max(options.minimumPadding, side / options.paddingDivisor),
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
    record(layout, context.notes)
    return layout
  }

  /// The smallest side that preserves all detail, and the number of textures required.
  private func usefulSize(_ map: ChartMap) -> (side: Int, count: Int) {
    var area: Float = 0
    for face in map.charts.indices {
      let (a, b, c) = (map.corners[3 * face], map.corners[3 * face + 1], map.corners[3 * face + 2])
      let scale = map.densities[Int(map.charts[face])] * options.sufficientMagnification
      area += abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2 * scale * scale
    }
    func capacity(_ side: Int) -> Float { options.expectedUsage * Float(side) * Float(side) }
    var side = options.maximumSide
    while side >= options.minimumHalvedSide, area < capacity(side / 2) { side /= 2 }
    let needed = (area / capacity(side)).rounded(.up)
    return (side, max(1, Int(min(needed, Float(options.maximumAtlases)))))
  }

  /// Records the texture size, and logs why it isn't larger.
  private func record(_ layout: AtlasLayout, _ notes: StageNotes) {
    notes.record("textureSide", Double(layout.side))
    notes.record("textures", Double(layout.count))
    notes.record("texelsPerPixel", Double(layout.magnification))
    let isFilled =
      layout.side == options.maximumSide && layout.count == options.maximumAtlases
    let texels = Double((100 * layout.magnification).rounded()) / 100
    func name(_ count: Int, _ side: Int) -> String { "\(count == 1 ? "" : "\(count) × ")\(side)²" }
    if !isFilled {
      notes.log(
        "The texture size is \(name(layout.count, layout.side)), not "
          + "\(name(options.maximumAtlases, options.maximumSide)) as the detail level allows: it "
          + "has \(texels) texels per photo pixel (linear), which preserves all detail.")
    } else if layout.magnification < 1 {
      notes.log(
        "The photos have more detail than the detail level's texture: it has \(texels) "
          + "texels per photo pixel (linear).")
    }
  }
}
