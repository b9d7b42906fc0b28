import SceneModel

/// The comparison of a run with ground truth; parts that are not available are nil.
package struct EvaluationReport: Codable, Hashable, Sendable {
  package var poses: PoseErrors?
  package var reprojection: ReprojectionStatistics?
  /// `referenceFromResult`.
  package var alignment: SimilarityTransform?
  package var triangles: Int?
  package var mesh: SurfaceScores?
  package var cloud: SurfaceScores?
  /// Scores of the voxel-downsampled cloud.
  package var averagedCloud: SurfaceScores?

  package init() {}
}
