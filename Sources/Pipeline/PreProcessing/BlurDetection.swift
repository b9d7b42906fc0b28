import Foundation
import SceneModel

/// Determines how much detail blurred photos have, by comparison with the rest of the set.
///
/// A blurred photo amounts to one with fewer pixels: reduced far enough, it is as sharp as the
/// others. Later stages use it like a photo of that size, so that it counts less where sharper
/// photos show the same. The sharpness of whole sets differs, so a photo counts as blurred only if
/// it is far below the set's median and not sharp in absolute terms either.
package struct BlurDetection: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Photos below this fraction of the median sharpness are blurred. Measured: on boot with six
    /// of 40 photos blurred (docs/experiments/2026-11-masks.md, Blur, concerns and sky).
    package var minimumShareOfMedian = 0.5
    /// Photos with at least this sharpness are never blurred: see `RasterImage.sharpness()`.
    /// Chosen.
    package var alwaysSharp = 0.75
    /// With fewer photos, the median is not meaningful and only extremely blurred photos count as
    /// blurred. Chosen.
    package var minimumPhotos = 3
    /// Sharpness below which a photo is extremely blurred. Chosen.
    package var minimumSharpness = 0.1
    /// Photos with the detail of fewer pixels show too little to align. Chosen.
    package var minimumPixels = 10_000.0

    package init() {}
  }

  /// The detail of a photo.
  package enum Result: Equatable, Sendable {
    case sharp
    /// The photo has no more detail than a sharp one with this number of pixels.
    case blurred(sharpPixels: Int)
    /// The photo has hardly any detail.
    case unusable
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The detail of each photo, from its sharpness at several sizes.
  package func run(_ photos: [SharpnessLadder]) -> [Result] {
    let sharpness = photos.map(\.atFullSize)
    var bound = options.minimumSharpness
    if sharpness.count >= options.minimumPhotos, let median = sharpness.upperMedian {
      bound = min(options.minimumShareOfMedian * median, options.alwaysSharp)
    }
    return photos.map { photo in
      guard photo.atFullSize < bound else { return .sharp }
      guard let pixels = photo.pixels(atSharpness: bound), pixels >= options.minimumPixels else {
        return .unusable
      }
      return .blurred(sharpPixels: Int(pixels.rounded()))
    }
  }
}
