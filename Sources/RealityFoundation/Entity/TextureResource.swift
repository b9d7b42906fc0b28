import ImageFiles
import Kernels
import SceneModel

/// An image that textures a surface.
public final class TextureResource: Sendable {
  /// The meaning of the values of an image.
  public enum Semantic: Hashable, Sendable {
    /// Colors in sRGB.
    case color
    /// Plain numbers.
    case raw
    /// Normals in tangent space.
    case normal
  }

  /// The meaning of the values.
  public let semantic: Semantic?
  private let image: RasterImage

  init(_ image: RasterImage, semantic: Semantic) {
    self.image = image
    self.semantic = semantic
  }

  /// The width in texels.
  public var width: Int { image.width }
  /// The height in texels.
  public var height: Int { image.height }
  /// The number of mipmap levels; only the full resolution exists.
  public var mipmapLevelCount: Int { 1 }

  /// The number of bytes per texel: 3 for red, green and blue, 1 for gray.
  ///
  /// An extension of this engine; on macOS textures are read through Metal.
  public var channelCount: Int { image.channels }

  /// All texels, the top row first.
  ///
  /// An extension of this engine; on macOS textures are read through Metal.
  public var texels: [UInt8] { image.pixels }

  /// The image as PNG data.
  ///
  /// An extension of this engine; on macOS textures are read through Metal.
  public func pngRepresentation() throws -> Data { Data(try ImageCodec.encodePNG(image)) }
}

extension TextureResource: Hashable {
  /// Whether both are the same image.
  public static func == (lhs: TextureResource, rhs: TextureResource) -> Bool { lhs === rhs }

  /// Hashes the identity of the image.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}
