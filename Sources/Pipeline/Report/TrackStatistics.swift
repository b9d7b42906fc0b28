import SceneModel

/// How many photos show the sparse points, and how well the points fit them.
package struct TrackStatistics: Hashable, Codable, Sendable {
  /// Number of sparse points by number of observations, from 0.
  package var lengths: [Int] = []
  /// Number of observations by reprojection error: bin i holds those from i to i + 1 times
  /// `residualStep` pixels, the last one all above, too.
  package var residuals = [Int](repeating: 0, count: Self.binCount)
  package var residualStep = Self.step

  /// Chosen: most errors are below one pixel, and the largest kept ones a few pixels.
  private static let (step, binCount) = (0.1, 40)

  /// `residuals` are those of the reconstruction.
  init(_ reconstruction: Reconstruction, residuals: [[Double]]) {
    for point in reconstruction.points {
      let length = point.track.count
      if lengths.count <= length {
        lengths += [Int](repeating: 0, count: length + 1 - lengths.count)
      }
      lengths[length] += 1
    }
    for residual in residuals.joined() where residual.isFinite {
      self.residuals[Int(min(residual / Self.step, Double(Self.binCount - 1)))] += 1
    }
  }
}
