import Formats
import ImageFiles
import SceneModel

/// How the textures of compressed GLB files are stored: as WebP.
package struct GLBCompression: Hashable, Codable, Sendable {
  /// Measured: on orbit, boot and saharov32 at 2048² texels, it has a PSNR of 42 to 44 dB, and the
  /// rendered model one of 48 dB against PNG, at an eighth to a twelfth of PNG's size.
  var color = ImageCodec.WebPQuality.lossy(quality: 0.9)
  /// Measured: on the same sets, normals deviate by 0.5 to 0.8° on average; lossless, they would
  /// take five times the size and be the largest part of the file.
  var normal = ImageCodec.WebPQuality.lossy(quality: 0.95)
  /// Occlusion and roughness, in one image or alone. Chosen: as for color.
  var surface = ImageCodec.WebPQuality.lossy(quality: 0.9)

  package init() {}

  /// Encodes a map; nil if it is larger than WebP permits.
  func encode(_ map: TextureMap, _ image: RasterImage) throws -> EncodedImage? {
    let quality =
      switch map {
      case .diffuseColor: color
      case .normal, .displacement: normal
      case .ambientOcclusion, .roughness: surface
      }
    return try encode(image, quality)
  }

  /// Encodes occlusion and roughness in one image; nil if it is larger than WebP permits.
  func encode(packed image: RasterImage) throws -> EncodedImage? { try encode(image, surface) }

  private func encode(
    _ image: RasterImage, _ quality: ImageCodec.WebPQuality
  ) throws -> EncodedImage? {
    guard max(image.width, image.height) <= ImageCodec.maximumWebPSide else { return nil }
    return EncodedImage(
      fileExtension: "webp", bytes: try ImageCodec.encodeWebP(image, quality))
  }
}
