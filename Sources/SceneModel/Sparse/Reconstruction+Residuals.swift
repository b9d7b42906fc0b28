extension Reconstruction {
  /// An observation, and the projection of its point minus it; in pixels of the photo.
  package struct Residual: Hashable, Sendable {
    package var pixel: SIMD2<Double>
    package var offset: SIMD2<Double>
  }

  /// The reprojection errors of the observations of each photo, by photo ID; none of a photo
  /// without a pose.
  package var residuals: [[Residual]] {
    var result = [[Residual]](repeating: [], count: photos.count)
    for point in points {
      for observation in point.track {
        let photo = observation.photo
        guard let pose = poses[photo.index] else { continue }
        let projected = camera(of: photo).project(pose * point.position)
        result[photo.index].append(
          Residual(pixel: observation.pixel, offset: projected - observation.pixel))
      }
    }
    return result
  }
}
