/// Types that materials share.
public enum MaterialParameters {
  /// A texture in a material.
  public struct Texture: Hashable, Sendable {
    /// The image.
    public var resource: TextureResource

    /// Creates a texture from an image.
    public init(_ resource: TextureResource) { self.resource = resource }
  }
}
