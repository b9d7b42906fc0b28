import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel

extension PageModel {
  /// Maximum side of a texture of a model that is viewed. Limit: what every browser can draw (WebGL
  /// 2 demands 2048, nearly all devices have 4096 and more).
  private static let viewedTextureSide = 4096
  /// Chosen: by eye.
  private static let viewedQuality: Float = 0.9

  /// A model from a file, with all its triangles. Textures that can't be decoded are left out.
  package init(_ model: LoadedModel, _ control: KernelControl) throws {
    let mesh = model.mesh
    let normals =
      mesh.normals.isEmpty ? mesh.angleWeightedNormals() : mesh.normals
    self.init(mesh.positions, normals: normals, triangles: mesh.triangles)
    let textures = try control.parallelMap(model.parts.count) {
      model.parts[$0].baseColor.flatMap(Self.texture)
    }
    let hasCoordinates = model.parts.contains { !$0.textureCoordinates.isEmpty }
    if hasCoordinates, textures.contains(where: { $0 != nil }) {
      set(coordinates: model.parts.flatMap(Self.coordinates))
    }
    if zip(textures, model.parts).contains(where: { $0 == nil || !$1.colors.isEmpty }) {
      colors = Data(rgb: model.parts.flatMap(Self.colors))
    }
    var first = 0
    parts = zip(model.parts, textures).map { part, texture in
      defer { first += part.triangles.count }
      return Part(first: first, count: part.triangles.count, texture: texture)
    }
  }

  /// Adds a heat map; `figures` have a value for each vertex of the model that was loaded.
  package mutating func show(_ figures: VertexFigures) {
    maps.append(Map(figures, figures.bytes))
  }

  /// The texture as a data URL; nil if it can't be decoded. Browsers read JPEG and WebP as they
  /// are; PNG would make the page several times as large.
  private static func texture(_ image: EncodedImage) -> String? {
    guard let decoded = try? ImageCodec.decode(image.bytes) else { return nil }
    let side = max(decoded.width, decoded.height)
    if image.fileExtension != "png", side <= viewedTextureSide {
      return image.dataURL
    }
    return try? decoded.fitted(to: viewedTextureSide).dataURL(quality: viewedQuality)
  }

  private static func coordinates(of part: LoadedModel.Part) -> [SIMD2<Float>] {
    part.textureCoordinates.isEmpty
      ? [SIMD2<Float>](repeating: .zero, count: part.positions.count) : part.textureCoordinates
  }

  /// The colors of a part's vertices, or its only one.
  private static func colors(of part: LoadedModel.Part) -> [SIMD3<UInt8>] {
    guard part.colors.isEmpty else { return part.colors }
    return [SIMD3<UInt8>](repeating: part.baseColorBytes, count: part.positions.count)
  }
}
