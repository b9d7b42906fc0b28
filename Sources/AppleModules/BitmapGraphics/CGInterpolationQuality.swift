/// How images are resampled when they are scaled.
public enum CGInterpolationQuality: Int32, Hashable, Sendable {
  /// The default quality.
  case `default`
  /// Nearest neighbor.
  case none
  /// Low quality, fast.
  case low
  /// High quality.
  case high
  /// Medium quality.
  case medium
}
