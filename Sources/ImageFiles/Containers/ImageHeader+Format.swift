import Kernels

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
    case cameraRaw = "camera raw"
    case openEXR = "OpenEXR"

    /// The error for a variant of the format that its decoder can't read.
    package var unsupportedVariant: ImageError {
      .unsupportedFormat("a kind of \(rawValue) image that can't be read")
    }

    /// The error for the failure of a decoder of the format; nil for damage.
    func error(for error: any Error) -> ImageError? {
      switch error as? KernelError {
      case .invalidArgument: unsupportedVariant
      case .leftOut: .decoderLeftOut(rawValue)
      default: nil
      }
    }
  }
}
