@testable import Formats

/// Stores what it should encode, and reverses the order of the vertices.
struct StoringCodec: GLTFMeshEncoder, GLTFMeshDecoder {
  struct Failure: Error {}

  var fails = false

  func order(
    _ indices: [UInt32], vertexCount: Int
  ) throws -> (indices: [UInt32], newFromOld: [UInt32]) {
    let last = UInt32(vertexCount) - 1
    return (indices.map { last - $0 }, (0..<UInt32(vertexCount)).map { last - $0 })
  }

  func encode(vertices: [UInt8], stride: Int) throws -> [UInt8] {
    if fails { throw Failure() }
    return vertices
  }

  func encode(triangles: [UInt32], vertexCount: Int) throws -> [UInt8] {
    var writer = ByteWriter()
    triangles.forEach { writer.append($0) }
    return writer.bytes
  }

  func vertices(_ encoded: [UInt8], count: Int, stride: Int) throws -> [UInt8] {
    guard encoded.count == count * stride else { throw Failure() }
    return encoded
  }

  func triangles(_ encoded: [UInt8], indexCount: Int) throws -> [UInt32] {
    var cursor = ByteCursor(encoded)
    return try cursor.values(UInt32.self, count: indexCount)
  }
}
