/// A mesh with texture coordinates and its atlases.
package struct TexturedMesh: Sendable {
  /// The mesh, with vertex normals.
  package var mesh: Mesh
  /// (0, 0) is the bottom-left corner of the texture.
  package var textureCoordinates: [SIMD2<Float>]
  /// For every triangle of the mesh, its three indices into `textureCoordinates`.
  package var textureTriangles: [Triangle]
  package var atlases: [TextureAtlas]

  package init(
    mesh: Mesh, textureCoordinates: [SIMD2<Float>], textureTriangles: [Triangle],
    atlases: [TextureAtlas]
  ) {
    self.mesh = mesh
    self.textureCoordinates = textureCoordinates
    self.textureTriangles = textureTriangles
    self.atlases = atlases
  }
}
