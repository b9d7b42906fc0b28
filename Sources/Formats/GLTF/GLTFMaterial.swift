/// The encoded images of one glTF material.
package struct GLTFMaterial: Equatable, Sendable {
  /// Maps that share one image in glTF: occlusion in red, roughness in green, metalness in blue.
  package enum Surface: Equatable, Sendable {
    case occlusion(EncodedImage)
    case roughness(EncodedImage)
    case occlusionAndRoughness(EncodedImage)
  }

  /// sRGB.
  package var baseColor: EncodedImage?
  /// Tangent space, green up.
  package var normal: EncodedImage?
  /// Occlusion and roughness; nil without either map.
  package var surface: Surface?

  package init(baseColor: EncodedImage? = nil, normal: EncodedImage? = nil, surface: Surface? = nil)
  {
    self.baseColor = baseColor
    self.normal = normal
    self.surface = surface
  }
}
