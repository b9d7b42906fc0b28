/// The encoded images of one glTF material.
package struct GLTFMaterial: Equatable, Sendable {
  /// What glTF reads from one image: occlusion from red, roughness from green, metalness from blue.
  package enum Surface: Equatable, Sendable {
    case occlusion(EncodedImage)
    case roughness(EncodedImage)
    case occlusionAndRoughness(EncodedImage)
  }

  /// sRGB.
  package var baseColor: EncodedImage?
  /// Tangent space, green up.
  package var normal: EncodedImage?
  package var surface: Surface?

  package init(baseColor: EncodedImage? = nil, normal: EncodedImage? = nil, surface: Surface? = nil)
  {
    self.baseColor = baseColor
    self.normal = normal
    self.surface = surface
  }
}
