import SceneModel

/// Detects photos that are too blurred to use, by comparison with the rest of the set.
///
/// The sharpness of whole sets differs, so a photo is rejected only if it is far below the set's
/// median and not sharp in absolute terms either.
package struct BlurDetection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Photos below this fraction of the median sharpness are suspect.
    package var minimumShareOfMedian = 0.3
    /// Photos with at least this sharpness are always kept: see `RasterImage.sharpness()`.
    package var alwaysSharp = 0.75
    /// With fewer photos, the median is not meaningful and only extremely blurred photos are
    /// rejected.
    package var minimumPhotos = 3
    /// Sharpness below which a photo is extremely blurred.
    package var minimumSharpness = 0.1

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns for each sharpness whether the photo is too blurred.
  package func run(_ sharpness: [Double]) -> [Bool] {
    guard sharpness.count >= options.minimumPhotos, let median = sharpness.upperMedian else {
      return sharpness.map { $0 < options.minimumSharpness }
    }
    let bound = min(options.minimumShareOfMedian * median, options.alwaysSharp)
    return sharpness.map { $0 < bound }
  }
}
