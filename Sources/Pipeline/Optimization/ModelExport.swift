import Foundation
import Formats
import Kernels
import SceneModel

/// Writes a textured model: one USDZ file, or a folder with OBJ, MTL, USDA and the textures.
package struct ModelExport: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// How colours, occlusion and roughness are stored. Normals and displacement are always PNG:
    /// the blocks of JPEG would show as dents in the light.
    package var textureFormat = TextureFormat.png
    /// Goes into the files' metadata.
    package var creator = "photogrammetry-cli"

    package init(textureFormat: TextureFormat = .png) { self.textureFormat = textureFormat }
  }

  package var options: Options

  package init(options: Options = Options()) { self.options = options }

  /// Writes a USDZ where the name ends in `.usdz`, else a folder. Either appears complete or not at
  /// all. Throws an error with file and remedy when it can't be written.
  package func run(_ model: TexturedMesh, to url: URL, _ context: StageContext) throws {
    let isPackage = url.pathExtension.lowercased() == "usdz"
    // Encoding takes a while: what can't be written is better known before.
    try AtomicFile.checkParent(of: url)
    let textures = try encoded(model, context.part(from: 0, to: 0.9))
    let content = ModelContent(mesh: model, textures: textures, creator: options.creator)
    try context.control.step(0.9)
    if isPackage {
      try USDZPackage.write(content, to: url)
    } else {
      try OBJFolder.write(content, to: url)
    }
  }

  private func encoded(
    _ model: TexturedMesh, _ context: StageContext
  ) throws -> [[EncodedTexture]] {
    let jobs = model.atlases.flatMap { atlas in
      atlas.maps.sorted { $0.key < $1.key }.map { (map: $0.key, image: $0.value) }
    }
    let images = try context.control.parallelMap(jobs.count) { index in
      try encode(jobs[index].map, jobs[index].image)
    }
    var rest = images[...]
    return model.atlases.map { atlas in
      defer { rest = rest.dropFirst(atlas.maps.count) }
      return Array(rest.prefix(atlas.maps.count))
    }
  }

  private func encode(_ map: TextureMap, _ image: RasterImage) throws -> EncodedTexture {
    switch options.textureFormat {
    case .jpeg(let quality) where map != .normal && map != .displacement:
      EncodedTexture(
        map: map, fileExtension: "jpg",
        bytes: try ImageCodec.encodeJPEG(image, quality: quality))
    default:
      EncodedTexture(map: map, fileExtension: "png", bytes: try ImageCodec.encodePNG(image))
    }
  }
}
