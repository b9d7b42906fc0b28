extension PhotogrammetrySession.Configuration {
  /// The limits of a model at the detail level `custom`.
  public struct CustomDetailSpecification: Equatable, Sendable {
    /// The maximum number of faces. A mesh of quads is made from at most this many triangles, so it
    /// has fewer faces. Chosen: as at the medium level.
    public var maximumPolygonCount: UInt = 100_000
    /// The maximum side of a texture.
    public var maximumTextureDimension = TextureDimension.fourK
    /// The textures to make.
    public var outputTextureMaps: TextureMapOutputs = [.diffuseColor, .normal, .ambientOcclusion]
    /// The file format of textures.
    public var textureFormat = TextureFormat.png

    /// Creates a specification with the limits of the detail level `medium`.
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
      /// One bit per texture.
      public let rawValue: UInt

      /// Creates a set from its bits.
      public init(rawValue: UInt) { self.rawValue = rawValue }

      /// The color of the surface.
      public static let diffuseColor = TextureMapOutputs(rawValue: 1 << 0)
      /// Normals with more detail than the mesh.
      public static let normal = TextureMapOutputs(rawValue: 1 << 1)
      /// The roughness of the surface.
      public static let roughness = TextureMapOutputs(rawValue: 1 << 2)
      /// Heights with more detail than the mesh.
      public static let displacement = TextureMapOutputs(rawValue: 1 << 3)
      /// The ambient light that reaches the surface.
      public static let ambientOcclusion = TextureMapOutputs(rawValue: 1 << 4)
      /// All of them.
      public static let all: TextureMapOutputs = [
        .diffuseColor, .normal, .roughness, .displacement, .ambientOcclusion,
      ]
    }

    /// The file format of textures.
    public enum TextureFormat: Equatable, Sendable {
      /// Lossless.
      case png
      /// Lossy, with a quality from 0 to 1 (best).
      case jpeg(compressionQuality: Float = 0.8)
    }
  }
}
