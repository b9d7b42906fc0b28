import Foundation
import Kernels
import SceneModel

/// Compares a model with photos that were held out of the input.
package struct PhotoComparison: Sendable {
  private let control: KernelControl

  package init(_ control: KernelControl) { self.control = control }

  /// Scores the model in each photo; nil without photos. `model` is in the frame of the cameras.
  ///
  /// Throws an `ImageError` for a photo or mask that can't be decoded.
  package func run(_ model: ShadedModel, _ photos: [HeldOutPhoto]) throws -> PhotoScoreSummary? {
    PhotoScoreSummary(try photos.compactMap { try scores(model, $0) })
  }

  /// Nil if the mask is empty.
  private func scores(_ model: ShadedModel, _ photo: HeldOutPhoto) throws -> PhotoScores? {
    let image = try photo.image()
    let mask = try photo.mask(for: image)
    let camera = photo.camera.fitted(to: image)
    let rows = try control.parallelMap(image.height) { row in
      (0..<image.width).map { column -> Pixel in
        let index = row * image.width + column
        guard mask.map({ $0.pixels[index] > 127 }) ?? true else { return Pixel() }
        let at = index * image.channels
        let drawn = camera.color(of: model, column: column, row: row)
        return Pixel(
          weight: 1, photo: SIMD3<Float>(image.bytes(at: at)) / 255,
          model: drawn ?? ShadedModel.background, isMissing: drawn == nil)
      }
    }
    let pixels = rows.flatMap { $0 }
    let gain = Self.gain(pixels)
    var (squares, count, missing) = (0.0, 0.0, 0.0)
    for pixel in pixels where pixel.weight > 0 {
      squares += Double((pixel.model * gain - pixel.photo).squaredLength)
      count += 1
      missing += pixel.isMissing ? 1 : 0
    }
    guard count > 0 else { return nil }
    let similarity = StructuralSimilarity(
      width: image.width, height: image.height, weights: pixels.map(\.weight))
    return PhotoScores(
      name: photo.camera.name, psnr: 10 * log10(1 / max(1e-9, squares / count / 3)),
      ssim: similarity.mean(
        pixels.map { ($0.model * gain).luma }, pixels.map(\.photo.luma)),
      missing: missing / count)
  }

  private struct Pixel: Sendable {
    /// 1 inside of the mask, else 0.
    var weight: Float = 0
    var photo = SIMD3<Float>.zero
    var model = SIMD3<Float>.zero
    var isMissing = false
  }

  /// The factor of each channel of the model with the least sum of squared differences.
  private static func gain(_ pixels: [Pixel]) -> SIMD3<Float> {
    var (products, squares) = (SIMD3<Double>.zero, SIMD3<Double>.zero)
    for pixel in pixels {
      let model = SIMD3<Double>(pixel.model)
      products += model * SIMD3<Double>(pixel.photo)
      squares += model * model
    }
    // A black model has no gain; any small number avoids dividing by zero.
    return SIMD3<Float>(products / pointwiseMax(squares, SIMD3(repeating: 1e-6)))
  }
}

extension SIMD3<Float> {
  /// Luma with the Rec. 601 weights.
  fileprivate var luma: Float { 0.299 * x + 0.587 * y + 0.114 * z }
}

extension RasterImage {
  fileprivate func bytes(at offset: Int) -> SIMD3<UInt8> {
    [pixels[offset], pixels[offset + 1], pixels[offset + 2]]
  }
}

extension NamedCamera {
  /// The camera for photos of the image's size. A camera whose size is a guess keeps its
  /// calibration.
  fileprivate func fitted(to image: RasterImage) -> NamedCamera {
    guard isSizeKnown else { return self }
    var result = self
    result.camera = camera.resized(width: image.width, height: image.height)
    return result
  }

  /// The color of the model at the center of a pixel; nil where there is no surface.
  fileprivate func color(of model: ShadedModel, column: Int, row: Int) -> SIMD3<Float>? {
    let (origin, direction) = ray(throughColumn: column, row: row)
    return model.color(from: origin, along: direction)
  }
}
