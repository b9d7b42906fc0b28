import Foundation
import SceneModel

/// Models as one USDZ file: an uncompressed zip with data aligned to 64 bytes, the crate layer
/// first (USDZ File Format Specification 1.3). Deterministic.
package enum USDZPackage {
  /// Writes `model`; throws `OutputError`.
  package static func write(_ model: ModelContent, to url: URL) throws {
    try AtomicFile.write(try encode(model, path: url.path), to: url)
  }

  /// The bytes that `write` writes; `path` is the file's path in errors.
  package static func encode(_ model: ModelContent, path: String = "model.usdz") throws -> [UInt8] {
    let description = USDModelLayer()
    var archive = StoredZip()
    archive.append("\(ModelContent.name).usdc", USDCrate.encode(description.layer(model)))
    for index in model.parts.indices {
      for texture in model.textures(ofPart: index) {
        archive.append(
          description.textureFolder + texture.fileName(atlas: index), texture.image.bytes)
      }
    }
    guard archive.size <= Int(UInt32.max) else {
      throw OutputError.tooLarge(path: path, bytes: archive.size)
    }
    return archive.finish()
  }
}
