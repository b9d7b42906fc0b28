/// A mesh and what it is made of.
public struct ModelComponent: Component, Sendable {
  /// The shape.
  public var mesh: MeshResource
  /// What the parts of the mesh are made of, by their `materialIndex`.
  public var materials: [any Material]
  /// How far the model may reach beyond the bounds of the mesh.
  public var boundsMargin: Float = 0

  /// Creates a model from its parts.
  public init(mesh: MeshResource, materials: [any Material]) {
    self.mesh = mesh
    self.materials = materials
  }
}
