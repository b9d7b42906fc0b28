import DamagedInput
import Foundation
import SceneModel
import Testing

@testable import Formats

/// Damaged models give a consistent model or an error. A reader that traps ends the test process.
@Suite struct DamagedModelsTests {
  private static let model = Sample.colored(rings: 2, atlasCount: 2, quads: 1)
  private static let materials = (0..<2).map { GLTFMaterial(baseColor: Sample.image($0)) }

  private static func file(_ name: String) throws -> [UInt8] {
    switch name {
    case "a.usdz": try USDZPackage.encode(model)
    case "a.usdc": USDCrate.encode(USDModelLayer().layer(model))
    case "a.usda": Array(USDAText.encode(USDModelLayer().layer(model)).utf8)
    case "a.glb": try GLBFile.encode(model.mesh, materials: materials, creator: "")
    case "b.glb":
      try GLBFile.encode(
        model.mesh, materials: materials, creator: "", compressedBy: StoringCodec())
    case "c.glb": Array(GLTFReadingTests.foreign.utf8)
    default: Array(OBJFolder.object(model).utf8)
    }
  }

  private static let names = [
    "a.usdz", "a.usdc", "a.usda", "a.glb", "b.glb", "c.glb", "a.obj",
  ]

  private func isConsistent(_ model: LoadedModel) -> Bool {
    model.parts.allSatisfy { part in
      let count = part.positions.count
      return !part.triangles.isEmpty && part.positions.allSatisfy(\.isFinite)
        && [part.normals.count, part.textureCoordinates.count, part.colors.count].allSatisfy {
          $0 == 0 || $0 == count
        } && part.triangles.allSatisfy { max($0.a, $0.b, $0.c) < count }
    }
  }

  /// Reads each copy; returns the numbers of models and of errors.
  private func outcomes(
    of copies: some Sequence<[UInt8]>, named name: String
  ) throws -> (models: Int, errors: Int) {
    // Without a file, whose writing would take longer than reading it.
    let url = URL(fileURLWithPath: "/nonexistent/\(name)")
    var (models, errors) = (0, 0)
    for copy in copies {
      do {
        #expect(isConsistent(try ModelFile.decode(copy, of: url, StoringCodec())))
        models += 1
      } catch is FormatError {
        errors += 1
      }
    }
    return (models, errors)
  }

  @Test(arguments: names) func truncatedFilesGiveAModelOrAnError(name: String) throws {
    let whole = DamagedInput(try Self.file(name))
    let result = try outcomes(of: whole.truncations(), named: name)
    // A part of an OBJ file is one, too; the other formats have an end, apart from a line break.
    #expect(result.errors >= (name == "a.obj" ? 1 : whole.bytes.count - 1))
  }

  @Test(arguments: names) func damagedFilesGiveAModelOrAnError(name: String) throws {
    let whole = DamagedInput(try Self.file(name))
    let copies = whole.mutations(3000, seed: 11, header: whole.bytes.count / 3)
    let result = try outcomes(of: copies, named: name)
    // Both must occur, or the damage is not what the test intends.
    #expect(result.models > 30 && result.errors > 300)
  }

  /// Each of the bytes of a small file is set to extreme values.
  @Test(arguments: ["a.usdc", "b.glb"]) func everyByteCanBeDamaged(name: String) throws {
    let whole = try Self.file(name)
    let copies = whole.indices.lazy.flatMap { index in
      ([0x00, 0x7F, 0x80, 0xFF] as [UInt8]).map { value in
        var copy = whole
        copy[index] = value
        return copy
      }
    }
    let result = try outcomes(of: copies, named: name)
    #expect(result.models > 100 && result.errors > 100)
  }

  @Test func damagedMaterialsAreRead() {
    let whole = DamagedInput(Array(OBJFolder.materials(Self.model).utf8))
    var found = 0
    for copy in whole.mutations(3000, seed: 12, header: whole.bytes.count) {
      found += MTLMaterial.materials(copy).count
    }
    for copy in whole.truncations() { found += MTLMaterial.materials(copy).count }
    #expect(found > 3000)
  }
}
