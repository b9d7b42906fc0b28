/// A material with color, normals, roughness, metalness and ambient occlusion.
public struct PhysicallyBasedMaterial: Material {
  /// A texture in a material.
  public typealias Texture = MaterialParameters.Texture

  /// The color.
  public var baseColor = BaseColor()
  /// Normals with more detail than the mesh.
  public var normal = Normal()
  /// The roughness.
  public var roughness = Roughness()
  /// The metalness.
  public var metallic = Metallic()
  /// The ambient occlusion.
  public var ambientOcclusion = AmbientOcclusion()

  /// Creates a material without textures.
  public init() {}

  /// The color of a surface.
  public struct BaseColor: Hashable, Sendable {
    /// Red, green and blue in sRGB.
    public var texture: Texture?

    /// Creates a color from a texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }

  /// The normals of a surface.
  public struct Normal: Hashable, Sendable {
    /// Normals in tangent space; (0.5, 0.5, 1) is flat, y points up.
    public var texture: Texture?

    /// Creates normals from a texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }

  /// The roughness of a surface.
  public struct Roughness: Hashable, Sendable {
    /// The factor of the texture, or the roughness if there is no texture.
    public var scale: Float
    /// Roughness from black (smooth) to white (rough).
    public var texture: Texture?

    /// Creates a roughness from a factor and a texture.
    public init(scale: Float = 1, texture: Texture? = nil) {
      self.scale = scale
      self.texture = texture
    }
  }

  /// The metalness of a surface.
  public struct Metallic: Hashable, Sendable {
    /// From 0 (dielectric) to 1 (metal).
    public var scale: Float
    /// Metalness from black (dielectric) to white (metal).
    public var texture: Texture?

    /// Creates a metalness from a factor and a texture.
    public init(scale: Float = 0, texture: Texture? = nil) {
      self.scale = scale
      self.texture = texture
    }
  }

  /// The ambient light that reaches a surface.
  public struct AmbientOcclusion: Hashable, Sendable {
    /// Ambient light from black (none) to white (all).
    public var texture: Texture?

    /// Creates an ambient occlusion from a texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }
}
