import Kernels
import SceneModel

/// The data term: which photos may colour a triangle, and how well.
///
/// Prefers views that show the triangle large, frontal and sharp; leaves out those whose colour
/// disagrees with the others' (a passer-by, a reflection, something the surface doesn't have), as
/// Waechter et al. (ECCV 2014) do.
struct ViewCandidates: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Views that disagree with the median by more are left out; gray levels 0…255.
    var colorTolerance: Float = 14
    /// The same in standard deviations of the other views.
    var deviations: Float = 3
    /// Exponent of the cosine in the quality, beyond its effect on the area.
    var cosinePower = 1
    /// Factor on the quality next to an occluding edge or the object's outline.
    var uncertainFactor: Float = 0.1
    /// At the outline, observations more oblique than this cosine show the background where the
    /// surface is a little too large; they are left out.
    var minimumCosineAtOutline: Float = 0.5
  }

  var options = Options()

  /// The views without outliers, a quality for each entry, and the agreed colour of each triangle.
  func run(
    _ views: FaceViews, gains: [SIMD3<Float>], _ context: StageContext
  ) throws -> RatedViews {
    var views = views
    for index in views.entries.indices {
      views.entries[index].color *= gains[Int(views.entries[index].view)]
    }
    let all = views.entries
    views.filter { index in
      let entry = all[index]
      return entry.isInterior || entry.cosine >= options.minimumCosineAtOutline
    }
    var isKept = [Bool](repeating: true, count: views.entries.count)
    for face in 0..<views.faceCount {
      if face % 16384 == 0 { try context.step(face, of: views.faceCount) }
      for index in outliers(views, face) { isKept[index] = false }
    }
    context.notes.count("outlierViews", Double(isKept.count { !$0 }))
    views.filter { isKept[$0] }
    var rated = RatedViews(
      views: views, qualities: Array(repeating: 0, count: views.entries.count),
      colors: Array(repeating: nil, count: views.faceCount))
    for face in 0..<views.faceCount { rate(face, &rated) }
    return rated
  }

  private func outliers(_ views: FaceViews, _ face: Int) -> [Int] {
    let range = views.range(of: face)
    guard range.count >= 4 else { return [] }
    var median = SIMD3<Float>.zero
    var deviation = SIMD3<Float>.zero
    for channel in 0..<3 {
      let values = range.map { views.entries[$0].color[channel] }
      median[channel] = Self.median(values)
      deviation[channel] = Self.median(values.map { abs($0 - median[channel]) })
    }
    let limit = pointwiseMax(
      deviation * (1.4826 * options.deviations), SIMD3(repeating: options.colorTolerance))
    let excess = range.map { index in
      let difference = views.entries[index].color - median
      return pointwiseMax(difference, -difference) / limit
    }
    return zip(range, excess).filter { $1.max() > 1 }.map(\.0)
  }

  private func rate(_ face: Int, _ rated: inout RatedViews) {
    let range = rated.views.range(of: face)
    guard !range.isEmpty else { return }
    // A gradient times a length doesn't depend on the distance, only on the focus.
    let sharpness = range.map {
      rated.views.entries[$0].gradient * rated.views.entries[$0].area.squareRoot()
    }
    let typical = max(Self.median(sharpness), 1e-3)
    var (sum, weight) = (SIMD3<Float>.zero, Float(0))
    for (index, sharp) in zip(range, sharpness) {
      let entry = rated.views.entries[index]
      var quality = entry.area * min(max(sharp / typical, 0.5), 1.5)
      for _ in 0..<options.cosinePower { quality *= entry.cosine }
      let isCertain = entry.isClear && entry.isInterior
      if !isCertain { quality *= options.uncertainFactor }
      rated.qualities[index] = quality
      let share = entry.cosine * (isCertain ? 1 : options.uncertainFactor)
      sum += entry.color * share
      weight += share
    }
    rated.colors[face] = sum / weight
  }

  /// The middle value, the higher of two.
  private static func median(_ values: [Float]) -> Float {
    values.isEmpty ? 0 : values.sorted()[values.count / 2]
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
