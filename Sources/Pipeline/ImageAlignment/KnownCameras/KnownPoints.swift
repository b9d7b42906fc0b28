import Kernels
import SceneModel

/// The sparse points of photos with known cameras: those that came with the cameras where they are
/// enough for the dense stage, else new ones.
struct KnownPoints: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Points that a photo sees, in the mean, from which on no others are looked for.
    var sufficientPoints = 50.0
    /// Largest median error of reprojection of points that came with the cameras, as a fraction of the
    /// photos' longer side: far beyond what the worst cameras have.
    var relativeMaximumError = 0.02
    var triangulation = KnownPoseTriangulation.Options()
  }

  var options = Options()

  func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    let photos = reconstruction.registered.count
    let observations = reconstruction.points.reduce(0) { $0 + $1.track.count }
    let given = reconstruction.points.count
    context.notes.count("givenPoints", Double(given))
    var result = reconstruction
    if Double(observations) >= options.sufficientPoints * Double(max(1, photos)) {
      try check(reconstruction)
    } else {
      if given > 0 {
        context.notes.tell(
          "The \(given) points that came with the cameras are too few; others are looked for.")
      }
      result = try KnownPoseTriangulation(options.triangulation)
        .run(reconstruction, images: images, context)
    }
    context.notes.count("points", Double(result.points.count))
    try context.control.step(1)
    return result
  }

  /// Throws where the points are nowhere near where the photos see them.
  private func check(_ reconstruction: Reconstruction) throws {
    let errors = reconstruction.points.flatMap { point in
      point.track.compactMap { observation -> Double? in
        guard let pose = reconstruction.poses[observation.photo.index] else { return nil }
        let camera = reconstruction.camera(of: observation.photo)
        let seen = pose * point.position
        guard seen.z > 0 else { return .infinity }
        let size = Double(max(camera.width, camera.height))
        return (camera.project(seen) - observation.pixel).length / size
      }
    }.sorted()
    guard let median = errors.isEmpty ? nil : errors[errors.count / 2],
      !(median <= options.relativeMaximumError)
    else { return }
    throw PipelineError.camerasDontFit(
      reason: "most points that came with them are not where the photos see them.")
  }
}
