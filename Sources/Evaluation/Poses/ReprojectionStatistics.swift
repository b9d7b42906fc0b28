import SceneModel

/// Statistics of the reprojection errors of a reconstruction, in pixels.
package struct ReprojectionStatistics: Codable, Hashable, Sendable {
  package var photos: Int
  package var points: Int
  package var observations: Int
  /// Mean number of observations per point.
  package var meanTrackLength: Double
  package var meanPixels: Double
  /// The mean over the points of each point's mean, as COLMAP reports it.
  package var meanOfPointsPixels: Double
  package var rootMeanSquarePixels: Double
  package var medianPixels: Double
  /// The 95th percentile.
  package var percentile95Pixels: Double

  /// Computes the statistics over all observations of registered photos, except of points behind
  /// the camera.
  package init(_ reconstruction: Reconstruction) {
    var errors: [Double] = []
    var (pointMeans, observedPoints) = (0.0, 0.0)
    for point in reconstruction.points {
      let first = errors.count
      for observation in point.track {
        guard let pose = reconstruction.poses[observation.photo.index] else { continue }
        let inCamera = pose * point.position
        guard inCamera.z > 0 else { continue }
        let pixel = reconstruction.camera(of: observation.photo).project(inCamera)
        errors.append((pixel - observation.pixel).length)
      }
      let own = errors[first...]
      guard !own.isEmpty else { continue }
      pointMeans += own.reduce(0, +) / Double(own.count)
      observedPoints += 1
    }
    errors.sort()
    let count = Double(max(1, errors.count))
    photos = reconstruction.registered.count
    points = reconstruction.points.count
    observations = errors.count
    meanTrackLength =
      Double(reconstruction.points.reduce(0) { $0 + $1.track.count }) / Double(max(1, points))
    meanPixels = errors.reduce(0, +) / count
    meanOfPointsPixels = pointMeans / max(1, observedPoints)
    rootMeanSquarePixels = (errors.reduce(0) { $0 + $1 * $1 } / count).squareRoot()
    medianPixels = errors.median
    percentile95Pixels = errors.isEmpty ? 0 : errors[min(errors.count - 1, errors.count * 95 / 100)]
  }
}
