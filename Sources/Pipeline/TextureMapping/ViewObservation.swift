import Kernels
import SceneModel

/// Determines which triangles each photo sees, and how well: rays to the corners and the center
/// test visibility.
struct ViewObservation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var rays = RayScene.ObservationOptions()
    /// Maximum pixels of the views; sufficient for triangles' mean colors. Chosen.
    var maximumPixels = 2_000_000
    /// Maximum observations kept per triangle; those with the largest area. Chosen.
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
    var pieces = try pieces(scene, faceCount: faceCount, views: views, source: source, context)
    return try FaceViews(
      draining: &pieces, faceCount: faceCount, maximumCount: options.maximumViews,
      context.part(from: 1, to: 1).control)
  }

  /// The observations of the first `faceCount` triangles by block of triangles, then by view.
  private func pieces(
    _ scene: RayScene, faceCount: Int, views: [ID<Photo>], source: ViewSource,
    _ context: StageContext
  ) throws -> [[[FaceObservation]]] {
    let byView = try context.control.parallelMap(views.count) { index in
      let view = try source.view(views[index], options.maximumPixels)
      var observations = try scene.observations(
        in: view, options: options.rays, KernelControl())
      let factor = source.areaFactor(of: view)
      for index in observations.indices { observations[index].area *= factor }
      return FaceViews.pieces(of: observations, faceCount: faceCount)
    }
    return (0..<FaceBlocks.count(faceCount: faceCount)).map { block in byView.map { $0[block] } }
  }
}
