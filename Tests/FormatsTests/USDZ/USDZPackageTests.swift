import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

@Suite struct USDZPackageTests {
  @Test func checksumMatchesTheReferenceValue() {
    #expect(CRC32.checksum(Array("123456789".utf8)) == 0xCBF4_3926)
    #expect(CRC32.checksum([]) == 0)
  }

  @Test func entriesAreStoredAlignedAndInOrder() throws {
    let model = Sample.model(rings: 6, atlasCount: 2)
    let bytes = try USDZPackage.encode(model)
    let entries = try Self.entries(of: bytes)
    #expect(
      entries.map(\.name) == [
        "baked_mesh.usdc", "0/baked_mesh_tex0.png", "0/baked_mesh_norm0.png",
        "0/baked_mesh_ao0.png", "0/baked_mesh_tex1.png", "0/baked_mesh_norm1.png",
        "0/baked_mesh_ao1.png",
      ])
    for entry in entries {
      #expect(entry.start % 64 == 0)
      let content = Array(bytes[entry.start..<(entry.start + entry.size)])
      #expect(CRC32.checksum(content) == entry.checksum)
    }
    let first = entries[1]
    #expect(
      Array(bytes[first.start..<(first.start + first.size)]) == Array("diffuseColor 0".utf8))
  }

  /// Names whose header ends 1 to 64 bytes before the next boundary.
  @Test func everyPaddingLengthIsValid() throws {
    for length in 1...64 {
      var zip = StoredZip()
      zip.append(String(repeating: "n", count: length), [1, 2, 3])
      let size = zip.size
      let bytes = zip.finish()
      #expect(bytes.count == size)
      let entry = try #require(try Self.entries(of: bytes).first)
      #expect(entry.start % 64 == 0)
      #expect(Array(bytes[entry.start..<(entry.start + 3)]) == [1, 2, 3])
    }
  }

  @Test func theSameModelGivesTheSameBytes() throws {
    let model = Sample.model(rings: 10)
    #expect(try USDZPackage.encode(model) == USDZPackage.encode(model))
  }

  @Test func emptyMeshIsWritten() throws {
    let empty = TexturedMesh(
      mesh: Mesh(), textureCoordinates: [], textureTriangles: [], atlases: [])
    let model = ModelContent(mesh: empty, textures: [], creator: "tests")
    #expect(try Self.entries(of: try USDZPackage.encode(model)).count == 1)
  }

  @Test func folderHoldsAllFormats() throws {
    try withTemporaryFolder { folder in
      let output = folder.appendingPathComponent("model")
      try OBJFolder.write(Sample.model(rings: 3), to: output)
      #expect(
        try FileManager.default.contentsOfDirectory(atPath: output.path).sorted() == [
          "baked_mesh.mtl", "baked_mesh.obj", "baked_mesh.usda", "baked_mesh_ao0.png",
          "baked_mesh_norm0.png", "baked_mesh_tex0.png",
        ])
      let text = try String(
        contentsOf: output.appendingPathComponent("baked_mesh.obj"), encoding: .utf8)
      let lines = text.split(separator: "\n")
      #expect(lines.count { $0.hasPrefix("f ") } == 36)
      #expect(lines.contains("f 1/1/1 2/2/2 9/9/9"))
      #expect(lines.contains("mtllib baked_mesh.mtl"))
    }
  }

  struct Entry {
    var name: String
    var start: Int
    var size: Int
    var checksum: UInt32
  }

  /// The entries of the central directory, checked against the local headers.
  static func entries(of bytes: [UInt8]) throws -> [Entry] {
    var end = ByteCursor(bytes, from: bytes.count - 22)
    #expect(try end.unsigned(4) == 0x0605_4B50)
    _ = try end.unsigned(4)
    let count = try end.unsigned(2)
    _ = try end.unsigned(6)
    var directory = ByteCursor(bytes, from: Int(try end.unsigned(4)))
    return try (0..<count).map { _ in
      #expect(try directory.unsigned(4) == 0x0201_4B50)
      _ = try directory.unsigned(6)
      #expect(try directory.unsigned(2) == 0)
      _ = try directory.unsigned(4)
      let checksum = UInt32(try directory.unsigned(4))
      let size = Int(try directory.unsigned(4))
      #expect(try directory.unsigned(4) == UInt64(size))
      let nameLength = Int(try directory.unsigned(2))
      for _ in 0..<3 { _ = try directory.unsigned(4) }
      let offset = Int(try directory.unsigned(4))
      let name = try (0..<nameLength).map { _ in UInt8(try directory.unsigned(1)) }
      var local = ByteCursor(bytes, from: offset)
      #expect(try local.unsigned(4) == 0x0403_4B50)
      for _ in 0..<11 { _ = try local.unsigned(2) }
      let (localName, extra) = (Int(try local.unsigned(2)), Int(try local.unsigned(2)))
      return Entry(
        name: String(decoding: name, as: UTF8.self), start: local.offset + localName + extra,
        size: size, checksum: checksum)
    }
  }
}
