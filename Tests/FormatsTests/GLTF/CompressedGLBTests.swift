import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct CompressedGLBTests {
  private let sphere = Sample.sphere(rings: 20, atlasCount: 2)
  private let materials = ["a", "b"].map {
    GLTFMaterial(baseColor: EncodedImage(fileExtension: "webp", bytes: Array($0.utf8)))
  }

  /// A parsed file, without the checks of `GLBReader`, which apply to a single buffer.
  private struct Parsed {
    let root: [String: Any]
    let binary: [UInt8]

    init(_ bytes: [UInt8]) throws {
      let length = bytes[12..<16].reversed().reduce(0) { $0 << 8 | Int($1) }
      let json = try JSONSerialization.jsonObject(with: Data(bytes[20..<20 + length]))
      root = try #require(json as? [String: Any])
      binary = Array(bytes[(28 + length)...])
    }

    func list(_ name: String) -> [[String: Any]] { root[name] as? [[String: Any]] ?? [] }

    func numbers(_ object: [String: Any], _ name: String) throws -> [Double] {
      try #require(object[name] as? [NSNumber]).map(\.doubleValue)
    }
  }

  private func parsed(_ mesh: TexturedMesh) throws -> Parsed {
    try Parsed(
      try GLBFile.encode(
        mesh, materials: materials, creator: "tests", compressedBy: StoringCodec()))
  }

  @Test func extensionsAreRequired() throws {
    let file = try parsed(sphere)
    let names = ["EXT_meshopt_compression", "KHR_mesh_quantization", "EXT_texture_webp"]
    #expect(file.root["extensionsRequired"] as? [String] == names)
    #expect(file.root["extensionsUsed"] as? [String] == names)
    for (index, texture) in file.list("textures").enumerated() {
      #expect(texture["source"] == nil)
      let webP = (texture["extensions"] as? [String: [String: Int]])?["EXT_texture_webp"]
      #expect(webP == ["source": index])
    }
    #expect(file.list("images").allSatisfy { $0["mimeType"] as? String == "image/webp" })
  }

  @Test func viewsReferToTheBufferWithoutData() throws {
    let file = try parsed(sphere)
    let buffers = file.list("buffers")
    #expect(buffers.count == 2)
    #expect(buffers[0]["byteLength"] as? Int == file.binary.count)
    let mark = (buffers[1]["extensions"] as? [String: [String: Bool]])?["EXT_meshopt_compression"]
    #expect(mark == ["fallback": true])
    #expect(buffers[1]["uri"] == nil)
    var end = 0
    for view in file.list("bufferViews") where view["extensions"] != nil {
      let extensions = try #require(view["extensions"] as? [String: [String: Any]])
      let packed = try #require(extensions["EXT_meshopt_compression"])
      let (stride, count) = (packed["byteStride"] as? Int ?? 0, packed["count"] as? Int ?? 0)
      #expect(view["buffer"] as? Int == 1)
      #expect(view["byteOffset"] as? Int == end)
      #expect(view["byteLength"] as? Int == stride * count)
      let isTriangles = packed["mode"] as? String == "TRIANGLES"
      #expect(isTriangles || packed["mode"] as? String == "ATTRIBUTES")
      // glTF allows a stride for vertices only.
      #expect(view["byteStride"] as? Int == (isTriangles ? nil : stride))
      #expect(view["target"] as? Int == (isTriangles ? 34963 : 34962))
      #expect(isTriangles ? stride == 2 : stride % 4 == 0)
      end = (end + stride * count + 3) / 4 * 4
    }
    #expect(buffers[1]["byteLength"] as? Int == end)
  }

  @Test func attributesAreWithinTheQuantizationSteps() throws {
    let file = try parsed(sphere)
    let node = try #require(file.list("nodes").first)
    let (origin, scale) = (try file.numbers(node, "translation"), try file.numbers(node, "scale"))
    #expect(Set(scale).count == 1)
    let primitives = try #require(file.list("meshes").first?["primitives"] as? [[String: Any]])
    for (primitive, atlas) in zip(primitives, sphere.atlases) {
      let expected = IndexedTriangles(sphere, triangles: atlas.triangles)
      let attributes = try #require(primitive["attributes"] as? [String: Int])
      let count = expected.positions.count
      func vertices(_ name: String) throws -> [[UInt8]] {
        let accessor = file.list("accessors")[try #require(attributes[name])]
        #expect(accessor["count"] as? Int == count)
        let view = file.list("bufferViews")[try #require(accessor["bufferView"] as? Int)]
        let extensions = try #require(view["extensions"] as? [String: [String: Any]])
        let packed = try #require(extensions["EXT_meshopt_compression"])
        let start = try #require(packed["byteOffset"] as? Int)
        let stride = try #require(packed["byteStride"] as? Int)
        return (0..<count).map { index in
          Array(file.binary[start + index * stride..<start + (index + 1) * stride])
        }
      }
      func short(_ bytes: [UInt8], _ index: Int) -> Double {
        Double(Int(bytes[2 * index]) | Int(bytes[2 * index + 1]) << 8)
      }
      let positions = try vertices("POSITION"), coordinates = try vertices("TEXCOORD_0")
      for old in 0..<count {
        let new = count - 1 - old
        let position = sphere.mesh.positions[Int(expected.positions[old])]
        for axis in 0..<3 {
          let value = origin[axis] + scale[axis] * short(positions[new], axis)
          #expect(abs(value - Double(position[axis])) <= 0.51 * scale[axis] + 1e-6)
        }
        let st = sphere.textureCoordinates[Int(expected.coordinates[old])]
        #expect(abs(short(coordinates[new], 0) / 65535 - Double(st.x)) <= 0.51 / 65535)
        #expect(abs(short(coordinates[new], 1) / 65535 - Double(1 - st.y)) <= 0.51 / 65535)
      }
      let bounds = file.list("accessors")[try #require(attributes["POSITION"])]
      for axis in 0..<3 {
        let values = positions.map { short($0, axis) }
        #expect(try file.numbers(bounds, "min")[axis] == values.min())
        #expect(try file.numbers(bounds, "max")[axis] == values.max())
      }
    }
  }

  @Test func normalsAreWithinADegree() {
    var largest = 0.0
    for normal in sphere.mesh.normals + [
      [1, 0, 0], [0, 0, -1], [-1, -1, -1], [1e-3, -1e-3, -1],
    ] {
      let bytes = OctahedralNormal.encode(normal).map { Float(Int8(bitPattern: $0)) / 127 }
      #expect(bytes[2] == 1 && bytes[3] == 0)
      var v = SIMD3(bytes[0], bytes[1], 1 - abs(bytes[0]) - abs(bytes[1]))
      let fold = max(-v.z, 0)
      v.x += v.x >= 0 ? -fold : fold
      v.y += v.y >= 0 ? -fold : fold
      let unit = normal.normalized, decoded = v.normalized
      let cosine = Double(unit.x * decoded.x + unit.y * decoded.y + unit.z * decoded.z)
      largest = max(largest, acos(min(1, cosine)) * 180 / .pi)
    }
    #expect(largest < 0.95)
    #expect(OctahedralNormal.encode([0, 0, 0]) == OctahedralNormal.encode([0, 1, 0]))
    #expect(OctahedralNormal.encode([.nan, 0, 0]) == OctahedralNormal.encode([0, 1, 0]))
  }

  @Test func largePartsHaveLongIndices() throws {
    let file = try parsed(Sample.sphere(rings: 190))
    let accessors = file.list("accessors").filter { $0["type"] as? String == "SCALAR" }
    #expect(accessors.map { $0["componentType"] as? Int } == [5125])
  }

  @Test func gridsOfUnusualPointsHaveASize() {
    let far = SIMD3<Float>(repeating: .infinity)
    for positions in [[], [SIMD3<Float>(1, 2, 3)], [.zero, far]] {
      let grid = PositionGrid(positions)
      #expect(grid.step > 0 && grid.step.isFinite)
      _ = grid.coordinates(of: [.nan, .infinity, -.infinity])
    }
  }

  @Test func aMeshWithoutTrianglesNeedsNoExtension() throws {
    let empty = TexturedMesh(
      mesh: Mesh(), textureCoordinates: [], textureTriangles: [], atlases: [])
    let bytes = try GLBFile.encode(
      empty, materials: [], creator: "tests", compressedBy: StoringCodec())
    #expect(Data(bytes).range(of: Data("extensions".utf8)) == nil)
  }

  @Test func errorsOfTheEncoderAreThrown() {
    #expect(throws: StoringCodec.Failure.self) {
      try GLBFile.encode(
        sphere, materials: materials, creator: "tests", compressedBy: StoringCodec(fails: true))
    }
  }
}
