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
    /// Photos below this fraction of the median sharpness are blurred.
    package var minimumShareOfMedian = 0.5
    /// Photos with at least this sharpness are never blurred: see `RasterImage.sharpness()`.
    package var alwaysSharp = 0.75
    /// With fewer photos, the median is not meaningful and only extremely blurred photos count as
    /// blurred.
    package var minimumPhotos = 3
    /// Sharpness below which a photo is extremely blurred.
    package var minimumSharpness = 0.1
    /// Photos with the detail of fewer pixels show too little to align.
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

/// The sharpness of a photo at several sizes: see `RasterImage.sharpness()`.
package struct SharpnessLadder: Equatable, Sendable {
  /// The largest number of pixels first.
  package var steps: [(pixels: Double, sharpness: Double)]

  /// Scales between the sizes, and their number.
  private static let (reduction, count) = (0.5, 4)

  package init(steps: [(pixels: Double, sharpness: Double)]) { self.steps = steps }

  /// Measures a gray image. Throws `KernelError.degenerate` if it has no texture.
  package init(_ image: RasterImage) throws {
    steps = [(Double(image.width * image.height), try image.sharpness())]
    var reduced = image
    for _ in 1..<Self.count {
      reduced = try reduced.resized(
        width: Int(Double(reduced.width) * Self.reduction),
        height: Int(Double(reduced.height) * Self.reduction))
      // The reduced image may be too small to be measured.
      guard let sharpness = try? reduced.sharpness() else { break }
      steps.append((Double(reduced.width * reduced.height), sharpness))
    }
  }

  package var atFullSize: Double { steps.first?.sharpness ?? 0 }

  package static func == (a: Self, b: Self) -> Bool { a.steps.elementsEqual(b.steps, by: ==) }

  /// The largest number of pixels at which the photo has the sharpness, interpolated between the
  /// logarithms of sizes; nil if it has it at none.
  func pixels(atSharpness bound: Double) -> Double? {
    guard let index = steps.firstIndex(where: { $0.sharpness >= bound }) else { return nil }
    guard index > 0 else { return steps[0].pixels }
    let (large, small) = (steps[index - 1], steps[index])
    let share = (bound - large.sharpness) / (small.sharpness - large.sharpness)
    return exp(log(large.pixels) + share * (log(small.pixels) - log(large.pixels)))
  }
}
