import VideoFiles

extension Check {
  /// Whether videos can be read.
  static func video(_ support: VideoSupport) -> Check {
    if case .supported(let version) = support {
      return Check(.video, .ok, "Videos are read through FFmpeg \(version).")
    }
    return Check(.video, .note, "Videos can't be read.", remedy: support.remedy)
  }
}
