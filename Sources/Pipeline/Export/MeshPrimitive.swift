/// The faces of a mesh.
package enum MeshPrimitive: String, CaseIterable, Codable, Sendable {
  case triangle
  /// Two triangles where they fit together, and triangles where they don't.
  case quad
}
