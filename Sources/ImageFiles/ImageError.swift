import Foundation

/// Why a file can't be read as an image; each message ends a sentence that starts with the file's
/// name.
package enum ImageError: LocalizedError, Hashable, Sendable {
  /// The actual format: "a HEIC image".
  case unsupportedFormat(String)
  /// The actual format, for which this program was built without a decoder: "camera raw".
  case decoderLeftOut(String)
  /// The actual type: "a text file".
  case notAnImage(String)
  /// Size in pixels.
  case tooLarge(width: Int, height: Int)
  /// The damage: "its PNG header is damaged or cut off".
  case damaged(String)
  /// The reason, or advice: "it is not a file".
  case unreadable(String)

  package var errorDescription: String? {
    switch self {
    case .unsupportedFormat(let name): "it is \(name); convert it to JPEG"
    case .decoderLeftOut(let name):
      "its format is \(name), and this program was built without a decoder for it; convert it to "
        + "JPEG or to TIFF with 16 bits, or use the program compiled from source"
    case .notAnImage(let name): "it is \(name), not a photo"
    case .tooLarge(let width, let height):
      "it has \(width) × \(height) pixels, more than can be processed; make it smaller"
    case .damaged(let detail): "\(detail); copy it from the camera again or leave it out"
    case .unreadable(let detail): "it can't be read: \(detail)"
    }
  }
}
