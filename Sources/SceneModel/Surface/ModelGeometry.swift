/// The crop and the placement of a model.
package struct ModelGeometry: Hashable, Sendable {
  /// The box, in the world frame, outside of which everything is removed; nil keeps all.
  package var crop: OrientedBox?
  /// `modelFromWorld`, applied last.
  package var transform = AffineMap.identity

  package init(crop: OrientedBox? = nil, transform: AffineMap = .identity) {
    self.crop = crop
    self.transform = transform
  }
}

extension TexturedMesh {
  /// The transformed model. Triangles stay counterclockwise under a reflection.
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
