/// A mesh and its materials.
public struct ModelComponent: Component, Sendable {
  /// The mesh.
  public var mesh: MeshResource
  /// The materials, indexed by the `materialIndex` of the mesh parts.
  public var materials: [any Material]
  /// The margin around the bounds of the mesh, in meters.
  public var boundsMargin: Float = 0

  /// Creates a model from a mesh and its materials.
  public init(mesh: MeshResource, materials: [any Material]) {
    self.mesh = mesh
    self.materials = materials
  }
}
