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

    /// The error for a variant of the format that its decoder can't read.
    package var unsupportedVariant: ImageError {
      .unsupportedFormat("a kind of \(rawValue) image that can't be read")
    }
  }
}
