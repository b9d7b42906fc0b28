import SceneModel

/// The geometry of two views, robustly estimated from matches with outliers.
package struct TwoViewGeometry: Sendable {
  /// Essential or fundamental matrix M of norm 1, `x₂ᵀ M x₁ = 0`.
  package var matrix: Matrix3
  /// The translation has unit length. Decomposed from the nearest essential matrix if uncalibrated.
  package var secondFromFirst: RigidTransform
  /// Indices of the inlier matches, ascending.
  package var inliers: [Int]
  /// Number of inliers that are also consistent with one homography.
  package var homographyInlierCount: Int
  /// Median triangulation angle of the inliers in radians.
  package var medianAngle: Double
  /// Number of samples drawn.
  package var iterations: Int
}
