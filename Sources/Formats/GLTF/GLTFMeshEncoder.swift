/// Encodes vertices and triangles for the glTF extension `EXT_meshopt_compression`.
///
/// This module has no C libraries; the caller provides the one that does it. The same input must
/// give the same bytes.
package protocol GLTFMeshEncoder: Sendable {
  /// Orders triangles so that they compress well: `indices` are three vertices per triangle in the
  /// new numbering, `newFromOld` has the new number of each vertex.
  func order(
    _ indices: [UInt32], vertexCount: Int
  ) throws -> (indices: [UInt32], newFromOld: [UInt32])

  /// Encodes vertices of `stride` bytes each: mode `ATTRIBUTES`.
  func encode(vertices: [UInt8], stride: Int) throws -> [UInt8]

  /// Encodes three vertex indices per triangle: mode `TRIANGLES`.
  func encode(triangles: [UInt32], vertexCount: Int) throws -> [UInt8]
}
