import Kernels
import SceneModel

/// The sparse points of photos with known cameras: the given points if they suffice for the dense
/// stage, newly triangulated ones otherwise.
struct KnownPoints: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Mean number of points observed per photo from which the given points suffice. Chosen.
    var sufficientPoints = 50.0
    /// Maximum median reprojection error of the given points, as a fraction of the photo's longer
    /// side: far beyond that of the worst usable cameras. Chosen.
    var relativeMaximumError = 0.02
    var triangulation = KnownPoseTriangulation.Options()
  }

  var options = Options()

  /// Returns the reconstruction with given or new points. Throws `PipelineError.camerasDontFit` if
  /// the points don't match the photos.
  func run(
    _ reconstruction: Reconstruction, images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    let photos = reconstruction.registered.count
    let observations = reconstruction.points.reduce(0) { $0 + $1.track.count }
    let given = reconstruction.points.count
    context.notes.record("givenPoints", Double(given))
    var result = reconstruction
    if Double(observations) >= options.sufficientPoints * Double(max(1, photos)) {
      try check(reconstruction)
    } else {
      if given > 0 {
        context.notes.log(
          "The \(given) points given with the cameras are too few; new points are triangulated.")
      }
      result = try KnownPoseTriangulation(options.triangulation)
        .run(reconstruction, images: images, context)
    }
    context.notes.record("points", Double(result.points.count))
    try context.control.step(1)
    return result
  }

  /// Throws if the median reprojection error of the points is implausibly large.
  private func check(_ reconstruction: Reconstruction) throws {
    let errors = reconstruction.points.flatMap { point in
      point.track.compactMap { observation -> Double? in
        guard let pose = reconstruction.poses[observation.photo.index] else { return nil }
        let camera = reconstruction.camera(of: observation.photo)
        let seen = pose * point.position
        guard seen.z > 0 else { return .infinity }
        let size = camera.longerSide
        return (camera.project(seen) - observation.pixel).length / size
      }
    }
    guard let median = errors.upperMedian, !(median <= options.relativeMaximumError) else { return }
    throw PipelineError.camerasDontFit(
      reason: "most points given with them are not where the photos see them.")
  }
}
