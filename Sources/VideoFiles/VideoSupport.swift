import CKernels

/// Whether this program can read videos.
///
/// FFmpeg's libraries are loaded when they are first needed: they load a hundred others, which
/// would slow down every start.
package enum VideoSupport: Hashable, Sendable {
  /// The version of FFmpeg.
  case supported(version: String)
  /// The program was built without FFmpeg's headers.
  case notBuilt
  /// The version of FFmpeg that the program was built for is not installed.
  case libraryMissing

  /// Loads the libraries unless they are loaded.
  package static var current: VideoSupport {
    switch ck_video_support() {
    case ck_video_supported: .supported(version: String(cString: ck_video_library_version()))
    case ck_video_library_missing: .libraryMissing
    default: .notBuilt
    }
  }

  /// What to do, as a sentence; nil if videos can be read.
  package var remedy: String? {
    switch self {
    case .supported: nil
    case .notBuilt:
      "To read videos, install FFmpeg's libraries (apt-get install libavformat-dev) and build "
        + "the program again with scripts/build, or use the packaged program, which contains them."
    case .libraryMissing:
      "To read videos, install FFmpeg's libraries again (apt-get install libavformat-dev), or "
        + "build the program again if their version has changed."
    }
  }
}
