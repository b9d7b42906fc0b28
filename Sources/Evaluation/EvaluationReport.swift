import SceneModel

/// The comparison of a run with ground truth; parts that are not available are nil.
package struct EvaluationReport: Codable, Hashable, Sendable {
  package var poses: PoseErrors?
  package var reprojection: ReprojectionStatistics?
  /// `referenceFromResult`, which all scores of surfaces apply.
  package var alignment: SimilarityTransform?
  /// Number of triangles of the mesh.
  package var triangles: Int?
  /// Scores of the mesh, and of all points of the cloud.
  package var mesh: SurfaceScores?
  package var cloud: SurfaceScores?
  /// Scores of the voxel-downsampled cloud.
  package var averagedCloud: SurfaceScores?

  package init() {}
}
