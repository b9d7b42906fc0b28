/// What part of the surface a model shows, and where it is put.
package struct ModelGeometry: Hashable, Sendable {
  /// The box outside of which everything is cut off; nil keeps all.
  package var crop: OrientedBox?
  /// What is applied to the model in the end: `modelFromWorld`.
  package var transform = AffineMap.identity

  package init(crop: OrientedBox? = nil, transform: AffineMap = .identity) {
    self.crop = crop
    self.transform = transform
  }
}

extension TexturedMesh {
  /// The model put elsewhere. Triangles stay counter-clockwise where the transform mirrors.
  package func transformed(by transform: AffineMap) -> TexturedMesh {
    guard transform != .identity else { return self }
    var result = self
    result.mesh.positions = mesh.positions.map { transform * $0 }
    result.mesh.normals = mesh.normals.map { transform.normal($0) }
    if transform.mirrors {
      result.mesh.triangles = mesh.triangles.map { Triangle($0.a, $0.c, $0.b) }
      result.textureTriangles = textureTriangles.map { Triangle($0.a, $0.c, $0.b) }
    }
    return result
  }
}
