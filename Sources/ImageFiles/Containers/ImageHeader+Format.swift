extension ImageHeader {
  /// The supported image formats.
  package enum Format: String, Hashable, Sendable, CaseIterable {
    case jpeg = "JPEG"
    case png = "PNG"
    case tiff = "TIFF"
    case bmp = "BMP"
    case webP = "WebP"
    case heic = "HEIC"
    case avif = "AVIF"
  }
}
