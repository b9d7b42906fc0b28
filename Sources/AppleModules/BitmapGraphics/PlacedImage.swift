import Foundation
import Kernels
import SceneModel

/// An image placed on a bitmap by a transform, ready for sampling.
struct PlacedImage {
  /// The bitmap pixels that the image may touch.
  let columns: Range<Int>
  let rows: Range<Int>
  private let raster: RasterImage
  /// Maps bitmap coordinates to the unit square of the image, both with y down from the top left.
  private let imageFromBitmap: CGAffineTransform
  /// Whether to interpolate between pixels.
  private let isSmooth: Bool

  /// Places an image; `transform` maps the unit square to the bitmap. Fails if nothing is visible.
  init?(_ raster: RasterImage, _ transform: CGAffineTransform, _ quality: CGInterpolationQuality) {
    let unit = CGRect(x: 0, y: 0, width: 1, height: 1)
    let box = unit.applying(transform)
    guard transform.a * transform.d - transform.b * transform.c != 0, box.minX.isFinite,
      box.minY.isFinite, box.maxX.isFinite, box.maxY.isFinite
    else { return nil }
    columns = pixelRange(box.minX, box.maxX, 65536)
    rows = pixelRange(box.minY, box.maxY, 65536)
    imageFromBitmap = transform.inverted()
    guard quality != .none else {
      (self.raster, isSmooth) = (raster, false)
      return
    }
    // Where the image is minified, downsample first so that all of its pixels contribute.
    let (width, height) = (
      Self.size(hypot(transform.a, transform.b), raster.width),
      Self.size(hypot(transform.c, transform.d), raster.height)
    )
    self.raster = (try? raster.resized(width: width, height: height)) ?? raster
    isSmooth = true
  }

  private static func size(_ length: CGFloat, _ size: Int) -> Int {
    length < CGFloat(size) ? max(1, Int(length.rounded())) : size
  }

  /// The color of the image at a bitmap pixel; nil outside the image.
  func pixel(_ x: Int, _ y: Int) -> PixelValue? {
    let point = CGPoint(x: CGFloat(x) + 0.5, y: CGFloat(y) + 0.5).applying(imageFromBitmap)
    // A bitmap pixel belongs to the image if its center is inside.
    guard point.x >= 0, point.x < 1, point.y >= 0, point.y < 1 else { return nil }
    let (u, v) = (point.x * CGFloat(raster.width), point.y * CGFloat(raster.height))
    guard isSmooth else { return value(Int(u), Int(v)) }
    let (left, top) = ((u - 0.5).rounded(.down), (v - 0.5).rounded(.down))
    let (s, t) = (u - 0.5 - left, v - 0.5 - top)
    let (column, row) = (Int(left), Int(top))
    // Fast path: most images are drawn with pixels aligned.
    let nearlyZero = 1e-3
    if s < nearlyZero, t < nearlyZero { return value(column, row) }
    if s > 1 - nearlyZero, t > 1 - nearlyZero { return value(column + 1, row + 1) }
    let upper = value(column, row).mixed(with: value(column + 1, row), s)
    return upper.mixed(with: value(column, row + 1).mixed(with: value(column + 1, row + 1), s), t)
  }

  /// A pixel of the image, clamped to its border.
  private func value(_ x: Int, _ y: Int) -> PixelValue {
    let (x, y) = (min(max(x, 0), raster.width - 1), min(max(y, 0), raster.height - 1))
    let at = (y * raster.width + x) * raster.channels
    let pixels = raster.pixels
    switch raster.channels {
    case 1: return PixelValue(pixels[at], pixels[at], pixels[at], 255)
    case 3: return PixelValue(pixels[at], pixels[at + 1], pixels[at + 2], 255)
    default: return PixelValue(pixels[at], pixels[at + 1], pixels[at + 2], pixels[at + 3])
    }
  }
}

extension PixelValue {
  /// The linear interpolation between this color (`part` 0) and another (`part` 1).
  fileprivate func mixed(with other: PixelValue, _ part: CGFloat) -> PixelValue {
    func between(_ a: UInt8, _ b: UInt8) -> UInt8 {
      UInt8(CGFloat(a) + (CGFloat(b) - CGFloat(a)) * part + 0.5)
    }
    return PixelValue(
      between(red, other.red), between(green, other.green), between(blue, other.blue),
      between(alpha, other.alpha))
  }
}
