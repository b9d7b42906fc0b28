import Kernels

/// The data term: which photos may color a triangle, and how well.
///
/// Prefers views that show the triangle large, frontal and sharp; excludes those that show
/// something else.
struct ViewCandidates: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var outliers = TransientOccluders.Options()
    /// Exponent of the cosine in the quality, in addition to its effect on the area.
    var cosinePower = 1
    /// Factor on the quality next to an occluding edge or the object's outline, and for
    /// overexposure.
    var uncertainFactor: Float = 0.1
    /// At the outline, observations below this cosine show background if the surface is slightly
    /// too large; they are excluded.
    var minimumCosineAtOutline: Float = 0.5
    /// Bounds of a view's sharpness relative to the triangle's median view, as a factor on the
    /// quality.
    var sharpnessRange: ClosedRange<Float> = 0.5...1.5
    /// Channel means at which overexposure becomes possible and certain, 0…255.
    var brightRange: ClosedRange<Float> = 225...248
  }

  var options = Options()

  /// The views without outliers, a quality for each entry, and the consensus color of each
  /// triangle.
  func run(
    _ views: FaceViews, gains: [ExposureGain], topology: MeshTopology, _ context: StageContext
  ) throws -> RatedViews {
    var views = views
    let all = views.entries
    views.filter { index in
      let entry = all[index]
      return entry.isInterior || entry.cosine >= options.minimumCosineAtOutline
    }
    for index in views.entries.indices {
      let entry = views.entries[index]
      views.entries[index].color = gains[Int(entry.view)].apply(entry.color)
    }
    let isOutlier = try TransientOccluders(options: options.outliers)
      .run(views, topology: topology, context)
    context.notes.record("outlierViews", Double(isOutlier.count { $0 }))
    views.filter { !isOutlier[$0] }
    let ratings = try context.part(from: 0, to: 0).control.parallelMap(
      views.faceCount, inUnitsOf: FaceViews.parallelUnit
    ) { [views] in rate($0, of: views, gains) }
    return RatedViews(
      views: views, qualities: ratings.flatMap(\.qualities), colors: ratings.map(\.color))
  }

  /// The qualities of a triangle's views, and its consensus color.
  private func rate(
    _ face: Int, of views: FaceViews, _ gains: [ExposureGain]
  ) -> (qualities: [Float], color: SIMD3<Float>?) {
    let entries = views.range(of: face)
    guard !entries.isEmpty else { return ([], nil) }
    var qualities: [Float] = []
    // A gradient times a length doesn't depend on the distance, only on the focus.
    let sharpness = entries.map {
      views.entries[$0].gradient * views.entries[$0].area.squareRoot()
    }
    let typical = max(sharpness.upperMedian ?? 0, 1e-3)
    var (sum, weight) = (SIMD3<Float>.zero, Float(0))
    let range = options.sharpnessRange
    for (index, sharp) in zip(entries, sharpness) {
      let entry = views.entries[index]
      var quality = entry.area * min(max(sharp / typical, range.lowerBound), range.upperBound)
      for _ in 0..<options.cosinePower { quality *= entry.cosine }
      let trust = trust(in: entry, gains[Int(entry.view)])
      quality *= trust
      qualities.append(quality)
      sum += entry.color * (entry.cosine * trust)
      weight += entry.cosine * trust
    }
    return (qualities, sum / weight)
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
