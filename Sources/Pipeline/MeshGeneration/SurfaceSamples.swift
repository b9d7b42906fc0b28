import SceneModel

/// The points that a surface is reconstructed from: the mean points of voxels, without those that
/// do not belong to the object or to the scene.
struct SurfaceSamples: Sendable {
  var cloud: PointCloud
  /// Side of the smallest voxel, in world units.
  var voxelSize: Double
  /// Whether they are of an object that was isolated.
  var isObject: Bool
  /// What the object stands on.
  var support: SupportPlane?
}
