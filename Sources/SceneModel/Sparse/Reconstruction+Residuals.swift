extension Reconstruction {
  /// The reprojection errors of the observations of each photo, in pixels, by photo ID; none of a
  /// photo without a pose.
  package var residuals: [[Double]] {
    var result = [[Double]](repeating: [], count: photos.count)
    for point in points {
      for observation in point.track {
        let photo = observation.photo
        guard let pose = poses[photo.index] else { continue }
        let projected = camera(of: photo).project(pose * point.position)
        result[photo.index].append((projected - observation.pixel).length)
      }
    }
    return result
  }
}
