/// Decodes vertices and triangles of the glTF extension `EXT_meshopt_compression`: the counterpart
/// of `GLTFMeshEncoder`.
///
/// This module has no C libraries; the caller provides the one that does it. Errors mean that the
/// bytes are damaged.
package protocol GLTFMeshDecoder: Sendable {
  /// Decodes `count` vertices of `stride` bytes each, a multiple of four up to 256: mode
  /// `ATTRIBUTES`.
  func vertices(_ encoded: [UInt8], count: Int, stride: Int) throws -> [UInt8]

  /// Decodes three vertex indices per triangle: mode `TRIANGLES`.
  func triangles(_ encoded: [UInt8], indexCount: Int) throws -> [UInt32]
}
