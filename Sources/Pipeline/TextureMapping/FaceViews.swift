import Kernels
import SceneModel

/// The observations of each triangle in the views.
struct FaceViews: Sendable {
  /// Observations of triangle i: `entries[offsets[i]..<offsets[i + 1]]`, ascending by view.
  private(set) var offsets: [Int32]
  var entries: [FaceObservation]

  var faceCount: Int { offsets.count - 1 }

  /// Groups observations, listed by view, by triangle.
  init(faceCount: Int, observationsByView: [[FaceObservation]]) {
    offsets = Array(repeating: 0, count: faceCount + 1)
    for observations in observationsByView {
      for observation in observations { offsets[Int(observation.face) + 1] += 1 }
    }
    for index in 0..<faceCount { offsets[index + 1] += offsets[index] }
    var next = offsets
    let empty = FaceObservation(face: 0, area: 0, cosine: 0, gradient: 0, color: .zero)
    entries = Array(repeating: empty, count: Int(offsets[faceCount]))
    for (view, observations) in observationsByView.enumerated() {
      for var observation in observations {
        observation.view = Int32(view)
        let face = Int(observation.face)
        entries[Int(next[face])] = observation
        next[face] += 1
      }
    }
  }

  func range(of face: Int) -> Range<Int> { Int(offsets[face])..<Int(offsets[face + 1]) }

  /// The index in `entries` of a view's observation of a triangle; nil if the view doesn't see it.
  func index(of face: Int, in view: Int32) -> Int? {
    range(of: face).first { entries[$0].view == view }
  }

  /// Keeps the entries that satisfy the predicate.
  mutating func filter(_ isIncluded: (Int) -> Bool) {
    var kept: [FaceObservation] = []
    kept.reserveCapacity(entries.count)
    var newOffsets: [Int32] = [0]
    newOffsets.reserveCapacity(offsets.count)
    for face in 0..<faceCount {
      for index in range(of: face) where isIncluded(index) { kept.append(entries[index]) }
      newOffsets.append(Int32(kept.count))
    }
    (entries, offsets) = (kept, newOffsets)
  }
}

/// Determines which triangles each photo sees, and how well: rays to the corners and the center
/// test visibility.
struct ViewObservation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var rays = RayScene.ObservationOptions()
    /// Maximum pixels of the views; sufficient for triangles' mean colors.
    var maximumPixels = 2_000_000
    /// Maximum observations kept per triangle; those with the largest area.
    var maximumViews = 24
  }

  var options = Options()

  /// Observations with areas in pixels of the full-size photos; views are numbered as in `views`.
  /// Restricted to the first `faceCount` triangles of the scene; nil means all.
  func run(
    _ scene: RayScene, faceCount: Int? = nil, views: [ID<Photo>], source: ViewSource,
    _ context: StageContext
  ) throws -> FaceViews {
    let faceCount = faceCount ?? scene.triangleCount
    var byView: [[FaceObservation]] = []
    for (index, photo) in views.enumerated() {
      try context.step(index, of: views.count)
      let view = try source.view(photo, options.maximumPixels)
      var observations = try scene.observations(
        in: view, options: options.rays, context.part(from: 0, to: 0).control)
      observations.removeAll { $0.face >= Int32(faceCount) }
      let factor = source.areaFactor(of: view)
      for index in observations.indices { observations[index].area *= factor }
      byView.append(observations)
    }
    var result = FaceViews(faceCount: faceCount, observationsByView: byView)
    limit(&result)
    return result
  }

  /// Keeps the largest observations of each triangle.
  private func limit(_ views: inout FaceViews) {
    var isKept = [Bool](repeating: true, count: views.entries.count)
    for face in 0..<views.faceCount {
      let range = views.range(of: face)
      guard range.count > options.maximumViews else { continue }
      let order = range.sorted {
        (views.entries[$0].area, $1) > (views.entries[$1].area, $0)
      }
      for index in order[options.maximumViews...] { isKept[index] = false }
    }
    views.filter { isKept[$0] }
  }
}
