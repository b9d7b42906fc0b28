import Foundation
import SceneModel

/// The sharpness of a photo at several sizes: see `RasterImage.sharpness()`.
package struct SharpnessLadder: Equatable, Codable, Sendable {
  package struct Step: Equatable, Codable, Sendable {
    package var pixels: Double
    package var sharpness: Double
  }

  /// The largest number of pixels first.
  package var steps: [Step]

  /// Scales between the sizes, and their number. Chosen.
  private static let (reduction, count) = (0.5, 4)

  package init(steps: [(pixels: Double, sharpness: Double)]) {
    self.steps = steps.map { Step(pixels: $0.pixels, sharpness: $0.sharpness) }
  }

  /// Measures a gray image. Throws `KernelError.degenerate` if it has no texture.
  package init(_ image: RasterImage) throws {
    steps = [Step(pixels: Double(image.width * image.height), sharpness: try image.sharpness())]
    var reduced = image
    for _ in 1..<Self.count {
      reduced = try reduced.resized(
        width: Int(Double(reduced.width) * Self.reduction),
        height: Int(Double(reduced.height) * Self.reduction))
      // The reduced image may be too small to be measured.
      guard let sharpness = try? reduced.sharpness() else { break }
      steps.append(
        Step(pixels: Double(reduced.width * reduced.height), sharpness: sharpness))
    }
  }

  package var atFullSize: Double { steps.first?.sharpness ?? 0 }

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
