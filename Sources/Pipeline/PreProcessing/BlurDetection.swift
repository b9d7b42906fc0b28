import SceneModel

/// Finds photos that are too blurred to use, by comparison with the rest of the set.
///
/// Sets differ in sharpness as a whole, so a photo is refused only when it is far below the set's
/// median and not sharp by any standard either.
package struct BlurDetection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Photos below this share of the median sharpness are suspect.
    package var minimumShareOfMedian = 0.3
    /// Photos at least this sharp are kept whatever the others are: see `RasterImage.sharpness()`.
    package var alwaysSharp = 0.75
    /// With fewer photos than this the median says nothing and only hopeless ones are refused.
    package var minimumPhotos = 3
    /// Sharpness of a hopeless photo.
    package var hopeless = 0.1

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Whether each photo is too blurred, by its sharpness.
  package func run(_ sharpness: [Double]) -> [Bool] {
    guard sharpness.count >= options.minimumPhotos else {
      return sharpness.map { $0 < options.hopeless }
    }
    let median = sharpness.sorted()[sharpness.count / 2]
    let bound = min(options.minimumShareOfMedian * median, options.alwaysSharp)
    return sharpness.map { $0 < bound }
  }
}
