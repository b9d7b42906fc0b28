import CKernels

/// Compresses vertices and triangles in the bitstream of the glTF extension
/// `EXT_meshopt_compression`, by the library meshoptimizer; deterministic.
package enum MeshoptCodec {
  /// Triangles in an order that compresses well.
  package struct Order: Equatable, Sendable {
    /// Three vertex indices per triangle, in the new numbering: that of first use.
    package var indices: [UInt32]
    /// The new number of each vertex; `UInt32.max` for one without a triangle.
    package var newFromOld: [UInt32]
  }

  /// Reorders triangles so that those that share vertices are neighbors, and numbers the vertices
  /// in order of first use.
  package static func order(_ indices: [UInt32], vertexCount: Int) throws -> Order {
    var order = Order(
      indices: [UInt32](repeating: 0, count: indices.count),
      newFromOld: [UInt32](repeating: .max, count: vertexCount))
    try withKernel(KernelControl()) { _ in
      ck_order_triangles(
        indices, indices.count, vertexCount, &order.indices, &order.newFromOld)
    }
    return order
  }

  /// Encodes vertices of `stride` bytes each, a multiple of 4 up to 256: mode `ATTRIBUTES`.
  package static func encode(vertices: [UInt8], stride: Int) throws -> [UInt8] {
    guard stride > 0, vertices.count % stride == 0 else {
      throw KernelError.invalidArgument("the last vertex is incomplete")
    }
    return try bytes { ck_encode_vertices(vertices, vertices.count / stride, stride, &$0) }
  }

  /// Encodes three vertex indices per triangle: mode `TRIANGLES`. Decoders may rotate the corners
  /// of a triangle.
  package static func encode(triangles: [UInt32], vertexCount: Int) throws -> [UInt8] {
    try bytes { ck_encode_triangles(triangles, triangles.count, vertexCount, &$0) }
  }

  private static func bytes(_ body: (inout OpaquePointer?) -> ck_status) throws -> [UInt8] {
    var encoded: OpaquePointer?
    try withKernel(KernelControl()) { _ in body(&encoded) }
    return [UInt8](taking: encoded)
  }
}

// MARK: - Decoding

extension MeshoptCodec {
  /// Decodes `count` vertices; throws `KernelError.failed` if the bytes are damaged.
  package static func vertices(
    _ encoded: [UInt8], count: Int, stride: Int
  ) throws -> [UInt8] {
    let (size, isTooLarge) = count.multipliedReportingOverflow(by: stride)
    guard count >= 0, stride >= 0, !isTooLarge else {
      throw KernelError.invalidArgument("the number of vertices is out of range")
    }
    var vertices = [UInt8](repeating: 0, count: size)
    try withKernel(KernelControl()) { _ in
      ck_decode_vertices(encoded, encoded.count, count, stride, &vertices)
    }
    return vertices
  }

  /// Decodes triangles with `indexCount` indices; throws `KernelError.failed` if the bytes are
  /// damaged. Damage that is not detected gives arbitrary indices.
  package static func triangles(_ encoded: [UInt8], indexCount: Int) throws -> [UInt32] {
    var indices = [UInt32](repeating: 0, count: max(0, indexCount))
    try withKernel(KernelControl()) { _ in
      ck_decode_triangles(encoded, encoded.count, indices.count, &indices)
    }
    return indices
  }

  /// Decodes unit vectors of four bytes from the filter `OCTAHEDRAL` to normalized bytes.
  package static func octahedralVectors(_ encoded: [UInt8]) throws -> [UInt8] {
    var vectors = encoded
    try withKernel(KernelControl()) { _ in ck_decode_octahedral(&vectors, vectors.count / 4) }
    return vectors
  }
}
