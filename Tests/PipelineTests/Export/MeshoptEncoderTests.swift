import Formats
import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshoptEncoderTests {
  private typealias Object = [String: Any]

  /// A parsed file whose views are decompressed.
  private struct Model {
    let root: Object
    let binary: [UInt8]

    init(_ bytes: [UInt8]) throws {
      let length = bytes[12..<16].reversed().reduce(0) { $0 << 8 | Int($1) }
      let json = try JSONSerialization.jsonObject(with: Data(bytes[20..<20 + length]))
      root = try #require(json as? Object)
      binary = Array(bytes[(28 + length)...])
    }

    func list(_ name: String) -> [Object] { root[name] as? [Object] ?? [] }

    func view(of accessor: Int) throws -> (bytes: [UInt8], description: Object) {
      let index = try #require(list("accessors")[accessor]["bufferView"] as? Int)
      let extensions = try #require(list("bufferViews")[index]["extensions"] as? [String: Object])
      let view = try #require(extensions["EXT_meshopt_compression"])
      let start = try #require(view["byteOffset"] as? Int)
      let size = try #require(view["byteLength"] as? Int)
      return (Array(binary[start..<start + size]), view)
    }

    func vertices(_ accessor: Int) throws -> [[UInt8]] {
      let (bytes, view) = try view(of: accessor)
      let count = try #require(view["count"] as? Int)
      let stride = try #require(view["byteStride"] as? Int)
      var decoded = try MeshoptCodec.vertices(bytes, count: count, stride: stride)
      if view["filter"] as? String == "OCTAHEDRAL" {
        decoded = try MeshoptCodec.octahedralVectors(decoded)
      }
      return (0..<count).map { Array(decoded[$0 * stride..<($0 + 1) * stride]) }
    }

    func triangles(_ accessor: Int) throws -> [UInt32] {
      let (bytes, view) = try view(of: accessor)
      return try MeshoptCodec.triangles(bytes, indexCount: try #require(view["count"] as? Int))
    }
  }

  /// The decoded file has the triangles of the mesh, each corner within the quantization step.
  @Test func theMeshIsDecodedWithinTheSteps() throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 4)
    let coordinates = mesh.positions.map { SIMD2<Float>(0.5 + $0.x / 2, 0.5 + $0.y / 2) }
    var textured = TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates, textureTriangles: mesh.triangles,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: [:])])
    textured.mesh.normals = mesh.positions.map(\.normalized)
    let bytes = try GLBFile.encode(
      textured, materials: [], creator: "tests", compressedBy: MeshoptEncoder())
    let plain = try GLBFile.encode(textured, materials: [], creator: "tests")
    #expect(3 * bytes.count < plain.count)
    let model = try Model(bytes)
    let primitives = try #require(model.list("meshes").first?["primitives"] as? [Object])
    let attributes = try #require(primitives[0]["attributes"] as? [String: Int])
    let positions = try model.vertices(try #require(attributes["POSITION"]))
    let normals = try model.vertices(try #require(attributes["NORMAL"]))
    let node = try #require(model.list("nodes").first)
    let origin = try #require(node["translation"] as? [NSNumber]).map(\.floatValue)
    let scale = try #require(node["scale"] as? [NSNumber]).map(\.floatValue)
    func position(_ index: UInt32) -> SIMD3<Float> {
      let b = positions[Int(index)].map(Int.init)
      return SIMD3(
        origin[0] + scale[0] * Float(b[0] | b[1] << 8),
        origin[1] + scale[1] * Float(b[2] | b[3] << 8),
        origin[2] + scale[2] * Float(b[4] | b[5] << 8))
    }
    let indices = try model.triangles(try #require(primitives[0]["indices"] as? Int))
    #expect(indices.count == 3 * mesh.triangles.count)
    var volume: Float = 0
    var largest: Float = 0
    for start in stride(from: 0, to: indices.count, by: 3) {
      let (a, b, c) = (
        position(indices[start]), position(indices[start + 1]), position(indices[start + 2])
      )
      volume += a.dot(b.cross(c)) / 6
      for index in indices[start..<start + 3] {
        let normal = normals[Int(index)].prefix(3).map { Float(Int8(bitPattern: $0)) }
        let cosine = SIMD3(normal[0], normal[1], normal[2]).normalized
          .dot(position(index).normalized)
        largest = max(largest, acos(min(1, cosine)))
      }
    }
    #expect(largest < 0.022)
    #expect(abs(volume - Float(mesh.volume)) < 1e-3 * abs(volume))
  }
}
