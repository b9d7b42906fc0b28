import Formats
import Kernels

/// Encodes the vertices and triangles of glTF files with the library meshoptimizer.
struct MeshoptEncoder: GLTFMeshEncoder {
  func order(
    _ indices: [UInt32], vertexCount: Int
  ) throws -> (indices: [UInt32], newFromOld: [UInt32]) {
    let order = try MeshoptCodec.order(indices, vertexCount: vertexCount)
    return (order.indices, order.newFromOld)
  }

  func encode(vertices: [UInt8], stride: Int) throws -> [UInt8] {
    try MeshoptCodec.encode(vertices: vertices, stride: stride)
  }

  func encode(triangles: [UInt32], vertexCount: Int) throws -> [UInt8] {
    try MeshoptCodec.encode(triangles: triangles, vertexCount: vertexCount)
  }
}
