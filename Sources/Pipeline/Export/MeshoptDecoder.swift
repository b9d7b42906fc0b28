import Formats
import Kernels

/// Decodes the vertices and triangles of compressed glTF files with the library meshoptimizer.
package struct MeshoptDecoder: GLTFMeshDecoder {
  package init() {}

  package func vertices(_ encoded: [UInt8], count: Int, stride: Int) throws -> [UInt8] {
    try MeshoptCodec.vertices(encoded, count: count, stride: stride)
  }

  package func triangles(_ encoded: [UInt8], indexCount: Int) throws -> [UInt32] {
    try MeshoptCodec.triangles(encoded, indexCount: indexCount)
  }
}
