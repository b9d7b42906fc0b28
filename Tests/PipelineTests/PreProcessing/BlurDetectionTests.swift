import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct BlurDetectionTests {
  private func ladder(_ sharpness: [Double]) -> SharpnessLadder {
    var pixels = 1_000_000.0
    return SharpnessLadder(
      steps: sharpness.map {
        defer { pixels /= 4 }
        return (pixels, $0)
      })
  }

  private let sharp = [1.6, 1.7, 1.8, 1.8]

  @Test func photosOfOneSharpnessAreSharp() {
    for scale in [0.2, 1, 2] {
      let photos = (0..<5).map { _ in ladder(sharp.map { $0 * scale }) }
      #expect(BlurDetection().run(photos) == Array(repeating: .sharp, count: 5))
    }
  }

  /// The detail of a blurred photo is that of the size at which it is sharp.
  @Test func blurredPhotosHaveFewerPixels() {
    let blurred = ladder([0.25, 0.75, 1.6, 1.8])
    let between = ladder([0.25, 0.5, 1, 1.8])
    let results = BlurDetection().run((0..<8).map { _ in ladder(sharp) } + [blurred, between])
    #expect(results.prefix(8).allSatisfy { $0 == .sharp })
    #expect(results[8] == .blurred(sharpPixels: 250_000))
    // Halfway between two sizes.
    #expect(results[9] == .blurred(sharpPixels: 125_000))
  }

  @Test func photosBlurredAtEverySizeAreUnusable() {
    let results = BlurDetection().run((0..<8).map { _ in ladder(sharp) } + [ladder([0.1, 0.1])])
    #expect(results[8] == .unusable)
  }

  @Test func photosWithTheDetailOfAStampAreUnusable() {
    let stamp = SharpnessLadder(steps: [(126_000, 0.1), (31_500, 0.1), (7900, 0.1), (2000, 1)])
    #expect(BlurDetection().run((0..<8).map { _ in ladder(sharp) } + [stamp])[8] == .unusable)
  }

  @Test func aPairOfPhotosHasNoMedian() {
    #expect(BlurDetection().run([ladder(sharp), ladder([0.2, 0.3])]) == [.sharp, .sharp])
  }

  /// Reduced to a quarter and enlarged again, a photo has about a sixteenth of the detail.
  @Test func detailOfAnEnlargedPhoto() throws {
    let sharp: [RasterImage] = (0..<5).map {
      TexturePattern.image(width: 800, height: 600, seed: UInt32($0)).gray
    }
    let enlarged = try sharp[0].resized(width: 200, height: 150).resized(width: 800, height: 600)
    let results = BlurDetection().run(try (sharp + [enlarged]).map(SharpnessLadder.init))
    #expect(results.prefix(5).allSatisfy { $0 == .sharp })
    guard case .blurred(let pixels) = results[5] else {
      Issue.record("The enlarged photo is not blurred: \(results[5])")
      return
    }
    let share = Double(pixels) / (800 * 600)
    #expect(share > 0.02 && share < 0.3)
  }
}
