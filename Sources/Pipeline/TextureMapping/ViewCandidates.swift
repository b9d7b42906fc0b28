import Kernels

/// The data term: which photos may color a triangle, and how well.
///
/// Prefers views that show the triangle large, frontal and sharp; excludes those that show
/// something else.
struct ViewCandidates: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var outliers = TransientOccluders.Options()
    /// Exponent of the cosine in the quality, in addition to its effect on the area. Chosen.
    var cosinePower = 1
    /// Factor on the quality next to an occluding edge or the object's outline, and for
    /// overexposure. Chosen.
    var uncertainFactor: Float = 0.1
    /// At the outline, observations below this cosine show background if the surface is slightly
    /// too large; they are excluded. Chosen.
    var minimumCosineAtOutline: Float = 0.5
    /// Bounds of a view's sharpness relative to the triangle's median view, as a factor on the
    /// quality. Chosen.
    var sharpnessRange: ClosedRange<Float> = 0.5...1.5
    /// Channel means at which overexposure becomes possible and certain, 0…255. Chosen.
    var brightRange: ClosedRange<Float> = 225...248
  }

  var options = Options()

  /// The views without outliers, with a quality of each, and the consensus color of each triangle.
  /// `views` is left empty.
  func run(
    draining views: inout FaceViews, gains: [ExposureGain], topology: MeshTopology,
    _ context: StageContext
  ) throws -> RatedViews {
    let control = context.part(from: 0, to: 0).control
    try views.updateBlocks(control) { [options] _, block in
      block.filter { _, entry in
        entry.isInterior || entry.cosine >= options.minimumCosineAtOutline
      }
      for index in block.entries.indices {
        let entry = block.entries[index]
        block.entries[index].color = gains[Int(entry.view)].apply(entry.color)
      }
    }
    let isOutlier = try TransientOccluders(options: options.outliers)
      .run(views, topology: topology, context)
    context.notes.record(
      "outlierViews", Double(isOutlier.blocks.reduce(0) { $0 + $1.count { $0 } }))
    let rated = try views.drainBlocks(control) { index, block in
      block.filter { entry, _ in !isOutlier.blocks[index][entry] }
      return rate(block, gains)
    }
    return RatedViews(
      views: FaceEntries(blocks: rated.map(\.views)), colors: rated.flatMap(\.colors))
  }

  /// The views of a block of triangles with their qualities, and the triangles' consensus colors.
  private func rate(
    _ block: FaceViews.Block, _ gains: [ExposureGain]
  ) -> (views: FaceEntries<RatedView>.Block, colors: [SIMD3<Float>?]) {
    var views: [RatedView] = []
    views.reserveCapacity(block.entries.count)
    var sharpness: [Float] = []
    let colors = (0..<block.faceCount).map { face -> SIMD3<Float>? in
      let range = block.range(of: face)
      guard !range.isEmpty else { return nil }
      // A gradient times a length doesn't depend on the distance, only on the focus.
      sharpness.removeAll(keepingCapacity: true)
      for entry in block.entries[range] {
        sharpness.append(entry.gradient * entry.area.squareRoot())
      }
      let typical = max(sharpness.sortedUpperMedian() ?? 0, 1e-3)
      var (sum, weight) = (SIMD3<Float>.zero, Float(0))
      for entry in block.entries[range] {
        let trust = trust(in: entry, gains[Int(entry.view)])
        let quality = quality(of: entry, typicalSharpness: typical) * trust
        views.append(
          RatedView(
            view: entry.view, quality: quality, area: entry.area, cosine: entry.cosine,
            color: entry.color))
        sum += entry.color * (entry.cosine * trust)
        weight += entry.cosine * trust
      }
      return sum / weight
    }
    let counts = (0..<block.faceCount).lazy.map { block.range(of: $0).count }
    return (.init(counts: counts, entries: views), colors)
  }

  /// How well a view shows a triangle, if its color can be trusted.
  private func quality(of entry: FaceObservation, typicalSharpness typical: Float) -> Float {
    let range = options.sharpnessRange
    let sharp = entry.gradient * entry.area.squareRoot()
    var quality = entry.area * min(max(sharp / typical, range.lowerBound), range.upperBound)
    for _ in 0..<options.cosinePower { quality *= entry.cosine }
    return quality
  }

  /// 1, or less if the color may belong to another surface or be overexposed.
  private func trust(in entry: FaceObservation, _ gain: ExposureGain) -> Float {
    let bright = options.brightRange
    let excess =
      (gain.stored(entry.color).max() - bright.lowerBound)
      / (bright.upperBound - bright.lowerBound)
    let exposed = 1 - (1 - options.uncertainFactor) * min(max(excess, 0), 1)
    return entry.isClear && entry.isInterior ? exposed : exposed * options.uncertainFactor
  }
}
