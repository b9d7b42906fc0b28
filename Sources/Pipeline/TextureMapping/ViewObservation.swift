import Kernels
import SceneModel

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
    let byView = try context.control.parallelMap(views.count) { index in
      let view = try source.view(views[index], options.maximumPixels)
      var observations = try scene.observations(
        in: view, options: options.rays, KernelControl())
      observations.removeAll { $0.face >= Int32(faceCount) }
      let factor = source.areaFactor(of: view)
      for index in observations.indices { observations[index].area *= factor }
      return observations
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
