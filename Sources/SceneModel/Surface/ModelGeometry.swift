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
      result.mesh.triangles = mesh.triangles.map(\.flipped)
      result.textureTriangles = textureTriangles.map(\.flipped)
      for half in atlases.flatMap({
        stride(from: $0.halves.lowerBound, to: $0.halves.upperBound, by: 2)
      }) {
        result.mesh.triangles.swapAt(half, half + 1)
        result.textureTriangles.swapAt(half, half + 1)
      }
    }
    return result
  }
}
