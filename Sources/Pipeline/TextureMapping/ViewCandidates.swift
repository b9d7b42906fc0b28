import Kernels
import SceneModel

/// The data term: which photos may colour a triangle, and how well.
///
/// Prefers views that show the triangle large, frontal and sharp; leaves out those that show
/// something else.
struct ViewCandidates: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var outliers = OutlierViews.Options()
    /// Exponent of the cosine in the quality, beyond its effect on the area.
    var cosinePower = 1
    /// Factor on the quality next to an occluding edge or the object's outline, and where the photo
    /// is overexposed.
    var uncertainFactor: Float = 0.1
    /// At the outline, observations more oblique than this cosine show the background where the
    /// surface is a little too large; they are left out.
    var minimumCosineAtOutline: Float = 0.5
    /// Mean values of a channel from which on a photo may be overexposed, and above which it is.
    var brightRange: ClosedRange<Float> = 225...248
  }

  var options = Options()

  /// The views without outliers, a quality for each entry, and the agreed colour of each triangle.
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
    let isOutlier = try OutlierViews(options: options.outliers)
      .run(views, topology: topology, context)
    context.notes.count("outlierViews", Double(isOutlier.count { $0 }))
    views.filter { !isOutlier[$0] }
    var rated = RatedViews(
      views: views, qualities: Array(repeating: 0, count: views.entries.count),
      colors: Array(repeating: nil, count: views.faceCount))
    for face in 0..<views.faceCount { rate(face, gains, &rated) }
    return rated
  }

  private func rate(_ face: Int, _ gains: [ExposureGain], _ rated: inout RatedViews) {
    let range = rated.views.range(of: face)
    guard !range.isEmpty else { return }
    // A gradient times a length doesn't depend on the distance, only on the focus.
    let sharpness = range.map {
      rated.views.entries[$0].gradient * rated.views.entries[$0].area.squareRoot()
    }
    let typical = max(sharpness.upperMedian ?? 0, 1e-3)
    var (sum, weight) = (SIMD3<Float>.zero, Float(0))
    for (index, sharp) in zip(range, sharpness) {
      let entry = rated.views.entries[index]
      var quality = entry.area * min(max(sharp / typical, 0.5), 1.5)
      for _ in 0..<options.cosinePower { quality *= entry.cosine }
      let trust = trust(in: entry, gains[Int(entry.view)])
      quality *= trust
      rated.qualities[index] = quality
      sum += entry.color * (entry.cosine * trust)
      weight += entry.cosine * trust
    }
    rated.colors[face] = sum / weight
  }

  /// 1, or less where the colour may be another thing's, or lost in the light.
  private func trust(in entry: FaceObservation, _ gain: ExposureGain) -> Float {
    let bright = options.brightRange
    let excess =
      (gain.stored(entry.color).max() - bright.lowerBound)
      / (bright.upperBound - bright.lowerBound)
    let exposed = 1 - (1 - options.uncertainFactor) * min(max(excess, 0), 1)
    return entry.isClear && entry.isInterior ? exposed : exposed * options.uncertainFactor
  }
}

/// Views with exposure-compensated colours that may colour each triangle.
struct RatedViews: Sendable {
  var views: FaceViews
  /// By entry of `views`; larger is better, comparable within a triangle.
  var qualities: [Float]
  /// The colour on which the views of a triangle agree; nil where none sees it.
  var colors: [SIMD3<Float>?]
}
