import SceneModel
import TestSupport
import Testing

@testable import Kernels

@Suite struct MeshoptCodecTests {
  private let sphere = SyntheticMesh.sphere(subdivisions: 3)
  private var indices: [UInt32] { sphere.triangles.flatMap { [$0.a, $0.b, $0.c] } }

  /// Triangles as sets of corners in a fixed order, independent of their order and rotation.
  private func canonical(_ indices: [UInt32]) -> [[UInt32]] {
    stride(from: 0, to: indices.count, by: 3).map { start in
      let t = Array(indices[start..<start + 3])
      let first = t.indices.min { t[$0] < t[$1] } ?? 0
      return (0..<3).map { t[(first + $0) % 3] }
    }.sorted { $0.lexicographicallyPrecedes($1) }
  }

  @Test func theOrderKeepsTheTriangles() throws {
    let order = try MeshoptCodec.order(indices, vertexCount: sphere.positions.count)
    let renumbered = indices.map { order.newFromOld[Int($0)] }
    #expect(canonical(order.indices) == canonical(renumbered))
    #expect(Set(order.newFromOld) == Set(0..<UInt32(sphere.positions.count)))
    var seen: UInt32 = 0
    for index in order.indices {
      #expect(index <= seen)
      seen = max(seen, index + 1)
    }
  }

  @Test func aVertexWithoutTriangleHasNoNumber() throws {
    let order = try MeshoptCodec.order([3, 1, 0], vertexCount: 5)
    #expect(order.newFromOld[2] == .max && order.newFromOld[4] == .max)
    #expect(Set([0, 1, 3].map { order.newFromOld[$0] }) == [0, 1, 2])
  }

  @Test(arguments: [4, 8, 12, 256])
  func verticesAreDecodedExactly(_ stride: Int) throws {
    var generator = SeededGenerator(seed: 7)
    let vertices = (0..<1000 * stride).map { _ in UInt8.random(in: 0...255, using: &generator) }
    let encoded = try MeshoptCodec.encode(vertices: vertices, stride: stride)
    #expect(encoded.first == 0xa0)
    #expect(encoded == (try MeshoptCodec.encode(vertices: vertices, stride: stride)))
    #expect(try MeshoptCodec.vertices(encoded, count: 1000, stride: stride) == vertices)
  }

  @Test func trianglesAreDecodedUpToRotation() throws {
    let order = try MeshoptCodec.order(indices, vertexCount: sphere.positions.count)
    let encoded = try MeshoptCodec.encode(
      triangles: order.indices, vertexCount: sphere.positions.count)
    #expect(encoded.first == 0xe1)
    #expect(encoded.count < 2 * sphere.triangles.count)
    let decoded = try MeshoptCodec.triangles(encoded, indexCount: order.indices.count)
    #expect(canonical(decoded) == canonical(order.indices))
  }

  @Test func emptyMeshesAreEncoded() throws {
    #expect(try MeshoptCodec.order([], vertexCount: 0).indices.isEmpty)
    let triangles = try MeshoptCodec.encode(triangles: [], vertexCount: 0)
    #expect(try MeshoptCodec.triangles(triangles, indexCount: 0).isEmpty)
    let vertices = try MeshoptCodec.encode(vertices: [], stride: 8)
    #expect(try MeshoptCodec.vertices(vertices, count: 0, stride: 8).isEmpty)
  }

  @Test func impossibleInputIsRejected() {
    func rejects(_ body: () throws -> Void) {
      #expect { try body() } throws: {
        if case KernelError.invalidArgument = $0 { true } else { false }
      }
    }
    rejects { _ = try MeshoptCodec.order([0, 1, 2], vertexCount: 2) }
    rejects { _ = try MeshoptCodec.order([0, 1], vertexCount: 2) }
    rejects { _ = try MeshoptCodec.encode(triangles: [0, 1, .max], vertexCount: 3) }
    for stride in [0, 3, 260] {
      let vertices = [UInt8](repeating: 0, count: 780)
      rejects { _ = try MeshoptCodec.encode(vertices: vertices, stride: stride) }
    }
    rejects { _ = try MeshoptCodec.encode(vertices: [0, 0, 0, 0, 0], stride: 4) }
    rejects { _ = try MeshoptCodec.vertices([], count: .max, stride: 8) }
    rejects { _ = try MeshoptCodec.triangles([], indexCount: 2) }
  }

  @Test func truncatedAndDamagedBytesDoNotTrap() throws {
    let vertices = (0..<4096).map { UInt8(truncatingIfNeeded: $0 * $0) }
    let encoded = try MeshoptCodec.encode(vertices: vertices, stride: 8)
    for count in stride(from: 0, to: encoded.count, by: 7) {
      #expect(throws: KernelError.self) {
        try MeshoptCodec.vertices(Array(encoded[..<count]), count: 512, stride: 8)
      }
    }
    let triangles = try MeshoptCodec.encode(
      triangles: indices, vertexCount: sphere.positions.count)
    var generator = SeededGenerator(seed: 3)
    for _ in 0..<500 {
      var damaged = triangles
      damaged[Int.random(in: 0..<damaged.count, using: &generator)] ^=
        1
        << UInt8.random(
          in: 0..<8, using: &generator)
      _ = try? MeshoptCodec.triangles(damaged, indexCount: indices.count)
    }
  }

  @Test func octahedralVectorsAreUnitVectors() throws {
    // +x, -y, +z, -z, and a fifth: not a multiple of four.
    let encoded: [UInt8] = [
      127, 0, 127, 0, 0, 129, 127, 0, 0, 0, 127, 0, 127, 127, 127, 0, 42, 42, 127, 0,
    ]
    let decoded = try MeshoptCodec.octahedralVectors(encoded).map { Int8(bitPattern: $0) }
    #expect(Array(decoded[0..<3]) == [127, 0, 0])
    #expect(Array(decoded[4..<7]) == [0, -127, 0])
    #expect(Array(decoded[8..<11]) == [0, 0, 127])
    #expect(Array(decoded[12..<15]) == [0, 0, -127])
    #expect(decoded[16..<19].allSatisfy { abs(Int($0) - 73) <= 1 })
  }
}
