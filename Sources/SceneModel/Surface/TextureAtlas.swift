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
