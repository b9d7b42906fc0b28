import SceneModel

/// The upper bounds of a model: the budgets of a detail level, or custom ones.
package struct DetailSpecification: Hashable, Codable, Sendable {
  /// Upper bound of the number of triangles.
  package var maximumTriangles: Int
  /// Upper bound of an atlas's side in texels.
  package var textureSide: Int
  package var maximumAtlases: Int
  package var maps: Set<TextureMap>
  package var textureFormat: TextureFormat
  /// The size in bytes above which a USDZ file stores its color as JPEG; nil keeps
  /// `textureFormat`.
  package var maximumBytes: Int?
  /// The number of pixels per view in the dense stage, matched to the detail of the model.
  package var viewPixels: Int

  package init(
    maximumTriangles: Int, textureSide: Int, maximumAtlases: Int = 1, maps: Set<TextureMap>,
    textureFormat: TextureFormat = .png, viewPixels: Int
  ) {
    self.maximumTriangles = maximumTriangles
    self.textureSide = textureSide
    self.maximumAtlases = maximumAtlases
    self.maps = maps
    self.textureFormat = textureFormat
    self.viewPixels = viewPixels
  }

  /// The budgets of one of Apple's levels.
  package init(_ level: DetailLevel) {
    let basic: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]
    switch level {
    case .preview:
      self.init(
        maximumTriangles: 24_999, textureSide: 1024, maps: basic, viewPixels: 80_000)
    case .reduced:
      self.init(
        maximumTriangles: 49_999, textureSide: 2048, maps: basic, viewPixels: 180_000)
      // The level is for the web and messages; Object Capture documents about 10 MB.
      maximumBytes = 10_000_000
    case .medium:
      self.init(
        maximumTriangles: 99_999, textureSide: 4096, maps: basic, viewPixels: 500_000)
    case .full:
      self.init(
        maximumTriangles: 249_999, textureSide: 8192, maps: Set(TextureMap.allCases),
        viewPixels: 2_000_000)
    case .raw:
      self.init(
        maximumTriangles: 29_999_999, textureSide: 8192, maximumAtlases: 16,
        maps: [.diffuseColor], viewPixels: 4_000_000)
    }
  }

  /// The specification with half the pixels per view and half the texture side.
  package var halved: DetailSpecification {
    var halved = self
    halved.viewPixels /= 2
    halved.textureSide /= 2
    return halved
  }
}
