import Formats
import ImageFiles
import Kernels
import SceneModel

extension ModelExport {
  /// A glTF material for each atlas, with encoded images.
  func materials(of model: TexturedMesh, _ context: StageContext) throws -> [GLTFMaterial] {
    // Images are encoded in parallel, three per material.
    let parts = try context.control.parallelMap(3 * model.atlases.count) { index in
      let maps = model.atlases[index / 3].maps
      return switch index % 3 {
      case 0: GLTFMaterial(baseColor: try encoded(.diffuseColor, of: maps))
      case 1: GLTFMaterial(normal: try encoded(.normal, of: maps))
      default: GLTFMaterial(surface: try surface(maps))
      }
    }
    try context.control.step(1)
    return model.atlases.indices.map { atlas in
      GLTFMaterial(
        baseColor: parts[3 * atlas].baseColor, normal: parts[3 * atlas + 1].normal,
        surface: parts[3 * atlas + 2].surface)
    }
  }

  private func encoded(
    _ map: TextureMap, of maps: [TextureMap: RasterImage]
  ) throws -> EncodedImage? {
    try maps[map].map { image in
      try options.glbCompression?.encode(map, image) ?? encode(map, image)
    }
  }

  /// The occlusion-roughness image of a material; nil without either map.
  private func surface(
    _ maps: [TextureMap: RasterImage]
  ) throws -> GLTFMaterial.Surface? {
    guard let roughness = maps[.roughness] else {
      return try encoded(.ambientOcclusion, of: maps).map { .occlusion($0) }
    }
    let packed = Self.packed(occlusion: maps[.ambientOcclusion], roughness: roughness)
    let image =
      try options.glbCompression?.encode(packed: packed)
      ?? EncodedImage(fileExtension: "png", bytes: try ImageCodec.encodePNG(packed))
    return maps[.ambientOcclusion] == nil ? .roughness(image) : .occlusionAndRoughness(image)
  }

  /// Occlusion in red (255 without a map), roughness in green, and 0 in blue: not metallic.
  /// `MapBaking` makes both the same size.
  private static func packed(occlusion: RasterImage?, roughness: RasterImage) -> RasterImage {
    var image = RasterImage(width: roughness.width, height: roughness.height, channels: 3)
    for texel in 0..<(image.width * image.height) {
      image.pixels[3 * texel] = occlusion?.pixels[texel] ?? 255
      image.pixels[3 * texel + 1] = roughness.pixels[texel]
    }
    return image
  }
}
