extension PhotogrammetrySession.Configuration {
  /// What a model of the detail level `custom` may have at most.
  public struct CustomDetailSpecification: Equatable, Sendable {
    /// The number of faces. A mesh of quads is made of no more triangles than that, and so has fewer.
    public var maximumPolygonCount: UInt = 100_000
    /// The side of a texture.
    public var maximumTextureDimension = TextureDimension.fourK
    /// The textures that are made.
    public var outputTextureMaps: TextureMapOutputs = [.diffuseColor, .normal, .ambientOcclusion]
    /// How textures are stored.
    public var textureFormat = TextureFormat.png

    /// Creates a specification with the bounds of the detail level `medium`.
    public init() {}

    /// The side of a square texture; the raw value is in texels.
    public enum TextureDimension: UInt, Hashable, Sendable {
      /// 1024 texels.
      case oneK = 1024
      /// 2048 texels.
      case twoK = 2048
      /// 4096 texels.
      case fourK = 4096
      /// 8192 texels.
      case eightK = 8192
      /// 16384 texels.
      case sixteenK = 16384
    }

    /// A set of textures.
    public struct TextureMapOutputs: OptionSet, Sendable {
      /// One bit a texture.
      public let rawValue: UInt

      /// Creates a set from its bits.
      public init(rawValue: UInt) { self.rawValue = rawValue }

      /// The colour of the surface.
      public static let diffuseColor = TextureMapOutputs(rawValue: 1 << 0)
      /// Surface directions finer than the mesh.
      public static let normal = TextureMapOutputs(rawValue: 1 << 1)
      /// How rough the surface is.
      public static let roughness = TextureMapOutputs(rawValue: 1 << 2)
      /// Heights finer than the mesh.
      public static let displacement = TextureMapOutputs(rawValue: 1 << 3)
      /// How much ambient light reaches the surface.
      public static let ambientOcclusion = TextureMapOutputs(rawValue: 1 << 4)
      /// All of them.
      public static let all: TextureMapOutputs = [
        .diffuseColor, .normal, .roughness, .displacement, .ambientOcclusion,
      ]
    }

    /// How textures are stored.
    public enum TextureFormat: Equatable, Sendable {
      /// Without loss.
      case png
      /// With loss; the quality runs from 0 to 1, best.
      case jpeg(compressionQuality: Float = 0.8)
    }
  }
}
