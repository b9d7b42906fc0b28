import ImageFiles
import ImageIO
import Kernels
import Pipeline

extension PhotogrammetrySample {
  /// Loads a photo from a file. Its id is the number at the end of the file name, or 0.
  public init(contentsOf url: URL) throws {
    let (buffer, read) = try Self.load(url)
    let digits = url.deletingPathExtension().lastPathComponent.reversed().prefix(9)
      .prefix { $0.isASCII && $0.isNumber }
    self.init(id: Int(String(digits.reversed())) ?? 0, image: buffer)
    apply(read)
  }

  /// Loads a photo from a file. Its id is the number at the end of the file name, or 0.
  public init(contentsOf url: URL) async throws {
    let load: () throws -> PhotogrammetrySample = { try PhotogrammetrySample(contentsOf: url) }
    self = try load()
  }

  private static func load(_ url: URL) throws -> (CVPixelBuffer, PhotoMetadata) {
    do throws(ImageError) {
      let bytes = try ImageCodec.contents(of: url)
      guard let buffer = CVPixelBuffer(try ImageCodec.decode(bytes)) else {
        throw .damaged("it has no pixels")
      }
      return (buffer, PhotoMetadata(bytes))
    } catch {
      throw ProcessingError(
        code: .invalidInput,
        reason: "\(url.path) can't be loaded: \(error.errorDescription ?? "it is damaged").",
        remedy: "Specify a photo: JPEG, HEIC or PNG.")
    }
  }

  private mutating func apply(_ read: PhotoMetadata) {
    orientation = CGImagePropertyOrientation(rawValue: UInt32(read.orientation)) ?? .up
    metadata = read.imageProperties
    captureTime = read.captureTime.flatMap(Self.date)
  }

  /// Parses an EXIF date such as `2024:05:17 12:34:56` in the local time zone.
  private static func date(_ text: String) -> Date? {
    let formatter = DateFormatter()
    formatter.locale = Locale(identifier: "en_US_POSIX")
    formatter.dateFormat = "yyyy:MM:dd HH:mm:ss"
    return formatter.date(from: text)
  }
}
