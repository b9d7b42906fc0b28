import Foundation
import Formats
import ImageFiles
import Kernels
import SceneModel

/// Writes a textured model: a USDZ, GLB or PLY file, or a folder with OBJ, MTL, USDA and the
/// textures.
package struct ModelExport: Sendable {
  /// Parameters of the export.
  package struct Options: Hashable, Codable, Sendable {
    /// Encoding of the color, occlusion and roughness maps. Normal and displacement maps are always
    /// PNG: JPEG blocks would show as dents under lighting. So are images that pack several maps,
    /// whose channels JPEG would mix.
    package var textureFormat = TextureFormat.png
    /// The size in bytes above which a USDZ file stores its color as `compactColor`; nil has no
    /// limit.
    package var maximumBytes: Int?
    /// JPEG at a third of PNG's size. Measured: a PSNR of 45.5 dB against PNG on saharov32
    /// (docs/experiments/2026-11-packages.md).
    var compactColor = TextureFormat.jpeg(quality: 0.97)
    /// How GLB files are compressed; nil stores numbers and textures as other formats do. Readers
    /// must support three extensions of glTF.
    package var glbCompression: GLBCompression?
    /// Written to the files' metadata.
    package var creator = "photogrammetry-cli"

    package init(textureFormat: TextureFormat = .png) { self.textureFormat = textureFormat }
  }

  package var options: Options

  package init(options: Options = Options()) { self.options = options }

  /// Writes the file or folder in the format that `ModelFormat` derives from the URL; it appears
  /// complete or not at all. Throws an error with file and remedy if it can't be written.
  package func run(_ model: TexturedMesh, to url: URL, _ context: StageContext) throws {
    // Encoding takes a while: check that the folder is writable first.
    try AtomicFile.checkParent(of: url)
    UnfinishedFiles.remove(from: url.deletingLastPathComponent(), of: url.lastPathComponent)
    let encoding = context.part(from: 0, to: 0.9)
    switch ModelFormat(of: url) {
    case .usdz:
      try USDZPackage.write(try packageContent(model, encoding), to: url)
    case .glb:
      let materials = try materials(of: model, encoding)
      try GLBFile.write(
        model, materials: materials, creator: options.creator,
        compressedBy: options.glbCompression.map { _ in MeshoptEncoder() }, to: url)
    case .ply:
      try PLY.write(
        try VertexColoring().run(model, encoding), halves: model.atlases.map(\.halves), to: url)
    case .folder:
      try OBJFolder.write(try content(model, encoding), to: url)
    }
  }

  /// The content of a USDZ file: with a compact color texture if the file would be too large.
  private func packageContent(
    _ model: TexturedMesh, _ context: StageContext
  ) throws -> ModelContent {
    var content = try content(model, context)
    guard let maximum = options.maximumBytes, try USDZPackage.encode(content).count > maximum
    else { return content }
    var compact = self
    compact.options.textureFormat = options.compactColor
    for (index, atlas) in model.atlases.enumerated() {
      content.textures[index] = try content.textures[index].map { texture in
        guard texture.map == .diffuseColor, let image = atlas.maps[.diffuseColor] else {
          return texture
        }
        return EncodedTexture(map: .diffuseColor, image: try compact.encode(.diffuseColor, image))
      }
    }
    return content
  }

  /// The model with its maps encoded, for USD and OBJ.
  private func content(_ model: TexturedMesh, _ context: StageContext) throws -> ModelContent {
    let jobs = model.atlases.flatMap { atlas in
      atlas.maps.sorted { $0.key < $1.key }.map { (map: $0.key, image: $0.value) }
    }
    let images = try context.control.parallelMap(jobs.count) { index in
      let (map, image) = jobs[index]
      return EncodedTexture(map: map, image: try encode(map, image))
    }
    try context.control.step(1)
    var rest = images[...]
    let textures = model.atlases.map { atlas in
      defer { rest = rest.dropFirst(atlas.maps.count) }
      return Array(rest.prefix(atlas.maps.count))
    }
    return ModelContent(mesh: model, textures: textures, creator: options.creator)
  }

  /// Encodes one map as JPEG or PNG.
  func encode(_ map: TextureMap, _ image: RasterImage) throws -> EncodedImage {
    switch options.textureFormat {
    case .jpeg(let quality) where map != .normal && map != .displacement:
      .init(fileExtension: "jpg", bytes: try ImageCodec.encodeJPEG(image, quality: quality))
    default:
      .init(fileExtension: "png", bytes: try ImageCodec.encodePNG(image))
    }
  }
}
