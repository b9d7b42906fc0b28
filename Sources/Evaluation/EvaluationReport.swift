import SceneModel

/// Everything that a comparison of a run with the truth gives; parts that were not there are nil.
package struct EvaluationReport: Codable, Hashable, Sendable {
  package var poses: PoseErrors?
  package var reprojection: ReprojectionStatistics?
  /// From the result's frame to the reference's.
  package var alignment: SimilarityTransform?
  package var triangles: Int?
  package var mesh: SurfaceScores?
  package var cloud: SurfaceScores?
  /// Of the cloud's means in voxels.
  package var averagedCloud: SurfaceScores?

  package init() {}
}
