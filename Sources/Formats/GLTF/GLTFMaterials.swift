import SceneModel

/// The base colors of the materials of an untrusted glTF file.
struct GLTFMaterials {
  /// What a material means for the base color.
  struct Appearance {
    var image: EncodedImage?
    /// Linear.
    var factor = SIMD3<Float>(1, 1, 1)
    /// The set of texture coordinates.
    var coordinates = 0
    /// `textureFromVertex`, with the origin at the top left.
    var transform = TextureTransform.identity
  }

  private let content: GLTFContent
  private var images: [Int: EncodedImage?] = [:]
  private(set) var missingFiles: [String] = []

  init(content: GLTFContent) { self.content = content }

  /// The appearance with a material, or without. Throws a `FormatFault`.
  mutating func appearance(_ index: Int?, _ buffers: inout GLTFBuffers) throws -> Appearance {
    var result = Appearance()
    guard let index else { return result }
    let material = try GLTFBuffers.element(content.materials, index, "material")
    let older = material.extensions?.specularGlossiness
    let factor = older?.diffuseFactor ?? material.pbrMetallicRoughness?.baseColorFactor
    if let factor, factor.count >= 3 {
      result.factor = SIMD3(Float(factor[0]), Float(factor[1]), Float(factor[2]))
    }
    guard let texture = older?.diffuseTexture ?? material.pbrMetallicRoughness?.baseColorTexture
    else { return result }
    result.image = try image(texture.index, &buffers)
    let transform = texture.extensions?.transform
    result.coordinates = transform?.texCoord ?? texture.texCoord ?? 0
    if let scale = transform?.scale, scale.count == 2 {
      result.transform.scale = SIMD2(Float(scale[0]), Float(scale[1]))
    }
    if let offset = transform?.offset, offset.count == 2 {
      result.transform.offset = SIMD2(Float(offset[0]), Float(offset[1]))
    }
    // glTF's angles are counterclockwise as seen in an image, where the second axis points down.
    result.transform.angle = -Float(transform?.rotation ?? 0)
    return result
  }

  private mutating func image(_ number: Int, _ buffers: inout GLTFBuffers) throws -> EncodedImage? {
    let texture = try GLTFBuffers.element(content.textures, number, "texture")
    guard let index = texture.extensions?.webP?.source ?? texture.source else {
      missingFiles.append("texture \(number)")
      return nil
    }
    if let image = images[index] { return image }
    let description = try GLTFBuffers.element(content.images, index, "image")
    let bytes =
      try description.bufferView.map { Array(try buffers.view($0)) }
      ?? description.uri.flatMap { buffers.file($0) }
    try buffers.budget.spend(bytes?.count ?? 0)
    let image = bytes.flatMap { EncodedImage(recognizing: $0) }
    images[index] = .some(image)
    if image == nil {
      let uri = description.uri.flatMap { $0.hasPrefix("data:") ? nil : $0 }
      missingFiles.append(uri ?? description.name ?? "image \(index)")
    }
    return image
  }
}
