import DamagedInput
import Formats
import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshoptDecoderTests {
  private static var textured: TexturedMesh {
    let mesh = SyntheticMesh.sphere(subdivisions: 3)
    let coordinates = mesh.positions.map { SIMD2<Float>(0.5 + $0.x / 2, 0.5 + $0.y / 2) }
    var textured = TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates, textureTriangles: mesh.triangles,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: [:])])
    textured.mesh.normals = mesh.positions.map(\.normalized)
    return textured
  }

  private static func compressed() throws -> [UInt8] {
    try GLBFile.encode(textured, materials: [], creator: "tests", compressedBy: MeshoptEncoder())
  }

  /// Encoding reorders triangles and vertices, so each vertex is compared with the sphere itself.
  @Test func compressedFilesAreRead() throws {
    let folder = try TemporaryFolder()
    let url = try folder.write(try Self.compressed(), as: "model.glb")
    let part = try #require(
      try ModelFile.read(url, decompressedBy: MeshoptDecoder()).parts.first)
    let source = Self.textured
    #expect(part.triangles.count == source.mesh.triangles.count)
    #expect(part.positions.count == source.mesh.positions.count)
    for (index, position) in part.positions.enumerated() {
      #expect(abs(position.length - 1) < 0.02)
      #expect((part.normals[index] - position.normalized).length < 0.04)
      let st = SIMD2<Float>(0.5 + position.x / 2, 0.5 + position.y / 2)
      #expect((part.textureCoordinates[index] - st).length < 1e-3)
    }
    for t in part.triangles {
      let (a, b, c) = (
        part.positions[Int(t.a)], part.positions[Int(t.b)], part.positions[Int(t.c)]
      )
      // Still counterclockwise seen from outside.
      #expect((b - a).cross(c - a).dot(a + b + c) > 0)
    }
  }

  @Test func damagedFilesGiveAModelOrAnError() throws {
    let whole = DamagedInput(try Self.compressed())
    let folder = try TemporaryFolder()
    var errors = 0
    for copy in whole.mutations(300, seed: 3, header: whole.bytes.count) {
      let url = try folder.write(copy, as: "model.glb")
      do {
        _ = try ModelFile.read(url, decompressedBy: MeshoptDecoder())
      } catch is FormatError {
        errors += 1
      }
    }
    #expect(errors > 30)
  }
}
