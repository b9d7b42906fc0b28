import SceneModel

/// The comparison of a run with ground truth; parts that are not available are nil.
package struct EvaluationReport: Codable, Hashable, Sendable {
  /// Meters per unit of the reference; nil if its unit is arbitrary.
  package var metersPerUnit: Double?
  package var poses: PoseErrors?
  package var reprojection: ReprojectionStatistics?
  /// `referenceFromResult`, which all scores of surfaces apply, and what it was determined by.
  package var alignment: SimilarityTransform?
  package var alignedBy: AlignmentMethod?
  /// Number of triangles of the mesh.
  package var triangles: Int?
  /// Scores of the mesh, and of all points of the cloud.
  package var mesh: SurfaceScores?
  package var cloud: SurfaceScores?
  /// Scores of the voxel-downsampled cloud.
  package var averagedCloud: SurfaceScores?
  package var density: CloudDensity?
  /// The textured model in photos that were held out.
  package var heldOut: PhotoScoreSummary?
  /// The model's outline in photos, or masks, against other masks.
  package var outline: OutlineScores?
  package var run: RunFigures?

  package init() {}

  /// Whether anything was compared or measured.
  package var isEmpty: Bool {
    poses == nil && reprojection == nil && mesh == nil && cloud == nil && density == nil
      && heldOut == nil && outline == nil
  }
}
