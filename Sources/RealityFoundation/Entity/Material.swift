/// What a surface is made of.
public protocol Material: Sendable {}

/// What materials have in common.
public enum MaterialParameters {
  /// A texture in a material.
  public struct Texture: Hashable, Sendable {
    /// The image.
    public var resource: TextureResource

    /// Creates a texture of an image.
    public init(_ resource: TextureResource) { self.resource = resource }
  }
}

/// A material by colour, relief, roughness and occlusion.
public struct PhysicallyBasedMaterial: Material {
  /// A texture in a material.
  public typealias Texture = MaterialParameters.Texture

  /// The colour.
  public var baseColor = BaseColor()
  /// The relief that is finer than the mesh.
  public var normal = Normal()
  /// How rough the surface is.
  public var roughness = Roughness()
  /// How much the surface is like metal.
  public var metallic = Metallic()
  /// How much ambient light reaches the surface.
  public var ambientOcclusion = AmbientOcclusion()

  /// Creates a material without textures.
  public init() {}

  /// The colour of a surface.
  public struct BaseColor: Hashable, Sendable {
    /// Red, green and blue, as sRGB has them.
    public var texture: Texture?

    /// Creates a colour from its texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }

  /// The relief of a surface.
  public struct Normal: Hashable, Sendable {
    /// Normals in tangent space; (0.5, 0.5, 1) is flat, y points up.
    public var texture: Texture?

    /// Creates a relief from its texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }

  /// The roughness of a surface.
  public struct Roughness: Hashable, Sendable {
    /// The factor of the texture, or the roughness where there is none.
    public var scale: Float
    /// Roughness from black, smooth, to white, rough.
    public var texture: Texture?

    /// Creates a roughness from a factor and a texture.
    public init(scale: Float = 1, texture: Texture? = nil) {
      self.scale = scale
      self.texture = texture
    }
  }

  /// How much a surface is like metal.
  public struct Metallic: Hashable, Sendable {
    /// From 0, not at all, to 1.
    public var scale: Float
    /// From black, not at all, to white.
    public var texture: Texture?

    /// Creates a value from a factor and a texture.
    public init(scale: Float = 0, texture: Texture? = nil) {
      self.scale = scale
      self.texture = texture
    }
  }

  /// The ambient light that reaches a surface.
  public struct AmbientOcclusion: Hashable, Sendable {
    /// Light from black, none, to white, all.
    public var texture: Texture?

    /// Creates an occlusion from its texture.
    public init(texture: Texture? = nil) { self.texture = texture }
  }
}
