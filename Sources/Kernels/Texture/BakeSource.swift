/// Input for baking the non-color maps.
package struct BakeSource: Sendable {
  /// Maximum distance of the dense surface from the textured one, in world units.
  package var maximumDistance: Float
  /// Unit normals of the textured surface, three per triangle.
  package var cornerNormals: [SIMD3<Float>]
  /// Unit tangents along u, with the sign of the bitangent; three per triangle.
  package var cornerTangents: [SIMD4<Float>]
  /// The surface before simplification.
  package var dense: RayScene
  /// The dense surface's unit normals, one per position.
  package var denseNormals: [SIMD3<Float>]

  package init(
    maximumDistance: Float, cornerNormals: [SIMD3<Float>], cornerTangents: [SIMD4<Float>],
    dense: RayScene, denseNormals: [SIMD3<Float>]
  ) {
    self.maximumDistance = maximumDistance
    self.cornerNormals = cornerNormals
    self.cornerTangents = cornerTangents
    self.dense = dense
    self.denseNormals = denseNormals
  }
}
