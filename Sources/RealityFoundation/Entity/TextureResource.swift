import ImageFiles
import Kernels
import SceneModel

/// An image on a surface.
public final class TextureResource: Sendable {
  /// What the values of an image mean.
  public enum Semantic: Hashable, Sendable {
    /// Colours, as sRGB has them.
    case color
    /// Numbers.
    case raw
    /// Normals in tangent space.
    case normal
  }

  /// What the values mean.
  public let semantic: Semantic?
  private let image: RasterImage

  init(_ image: RasterImage, semantic: Semantic) {
    self.image = image
    self.semantic = semantic
  }

  /// The texels of a row.
  public var width: Int { image.width }
  /// The texels of a column.
  public var height: Int { image.height }
  /// The number of images of falling size; there is only the full one.
  public var mipmapLevelCount: Int { 1 }

  /// The bytes of a texel: 3 for red, green and blue, 1 for gray.
  ///
  /// This engine's own; on a Mac textures are read by Metal.
  public var channelCount: Int { image.channels }

  /// All texels, the top row first.
  ///
  /// This engine's own; on a Mac textures are read by Metal.
  public var texels: [UInt8] { image.pixels }

  /// The image as a PNG file.
  ///
  /// This engine's own; on a Mac textures are read by Metal.
  public func pngRepresentation() throws -> Data { Data(try ImageCodec.encodePNG(image)) }
}

extension TextureResource: Hashable {
  /// Whether both are the same image.
  public static func == (lhs: TextureResource, rhs: TextureResource) -> Bool { lhs === rhs }

  /// Hashes the identity of the image.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}
