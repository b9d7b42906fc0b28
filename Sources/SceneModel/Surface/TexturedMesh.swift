/// The texture maps of a material.
package enum TextureMap: String, Hashable, CaseIterable, Comparable, Codable, Sendable {
  case diffuseColor, normal, roughness, displacement, ambientOcclusion

  package static func < (lhs: Self, rhs: Self) -> Bool {
    allCases.firstIndex(of: lhs)! < allCases.firstIndex(of: rhs)!
  }
}

/// One texture atlas and the triangles that use it.
package struct TextureAtlas: Sendable {
  /// The triangles of the mesh that this atlas covers; the ranges of the atlases are contiguous.
  package var triangles: Range<Int>
  /// Square images of the same side length, top row first. Normal maps are tangent-space RGB (0.5,
  /// 0.5, 1 is flat; +y up as in OpenGL); occlusion, roughness and displacement are gray.
  package var maps: [TextureMap: RasterImage]
  /// Number of quads a, b, c, d; each is two of the first triangles, (a, b, c) and (a, c, d).
  package var quadCount = 0

  package init(triangles: Range<Int>, maps: [TextureMap: RasterImage]) {
    self.triangles = triangles
    self.maps = maps
  }

  /// The triangles that are halves of quads.
  package var halves: Range<Int> {
    triangles.lowerBound..<triangles.lowerBound + 2 * quadCount
  }
}

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
