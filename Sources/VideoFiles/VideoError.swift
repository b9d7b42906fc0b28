import Foundation

/// Why frames can't be read from a video; each message ends a sentence that starts with the file's
/// name.
package enum VideoError: LocalizedError, Hashable, Sendable {
  /// The file can't be opened or decoded; with the reason.
  case unreadable(String)
  /// No frame is intact, or there are fewer than a reconstruction needs.
  case tooFewFrames(Int)

  package var errorDescription: String? {
    switch self {
    case .unreadable(let reason):
      "it can't be read as a video (\(reason)); copy it from the camera again, or convert it to "
        + "MP4 with H.264"
    case .tooFewFrames(0): "none of its frames can be decoded; copy it from the camera again"
    case .tooFewFrames(let count):
      "it has only \(count) frame\(count == 1 ? "" : "s"); film the object for at least ten "
        + "seconds from all sides"
    }
  }
}
