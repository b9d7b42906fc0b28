import Foundation
import SceneModel

/// A small copy of a photo, with the outline of its mask and its reprojection errors.
package struct PhotoPicture: Encodable, Sendable {
  /// A data URL.
  package var picture: String
  package var width: Int
  package var height: Int
  /// Closed polygons: x, y in 16 bits each, 0…65535 of width and height.
  package var outlines: [Data] = []
  /// The largest reprojection errors: x, y of the observation like those of outlines, then the
  /// projected point minus the observation in hundredths of a pixel of the photo, signed.
  package var residuals = Data()

  /// Chosen: 5 KB, and no more than can be distinguished.
  private static let maximumResiduals = 600
  /// Chosen: by eye; artifacts are not visible at this size.
  private static let quality: Float = 0.6

  /// `image` is RGB.
  init(_ image: RasterImage) throws {
    (width, height) = (image.width, image.height)
    picture = try image.dataURL(quality: Self.quality)
  }

  /// The longer side of the picture of one of `count` photos, in pixels: the pixels of all photos
  /// together are those of 60 at the largest size, so that a page of a thousand photos can be
  /// opened.
  static func side(count: Int) -> Int {
    // Measured: a page of 1000 photos has 34 MB and opens in 2.4 s
    // (docs/experiments/2026-11-reports.md).
    let (largest, smallest, full) = (576.0, 320.0, 60.0)
    return Int(max(smallest, min(largest, largest * (full / Double(max(1, count))).squareRoot())))
  }

  mutating func add(_ outlines: MaskOutlines, of mask: RasterImage) {
    let scale = SIMD2(65535 / Double(mask.width), 65535 / Double(mask.height))
    self.outlines = outlines.smoothed.map { polygon in
      var numbers: [UInt16] = []
      for corner in polygon {
        numbers.append(UInt16(corner.x * scale.x))
        numbers.append(UInt16(corner.y * scale.y))
      }
      return Data(littleEndian: numbers)
    }
  }

  /// `size` is that of the photo in pixels.
  mutating func add(_ residuals: [Reconstruction.Residual], size: SIMD2<Double>) {
    let largest = residuals.sorted { $0.offset.squaredLength > $1.offset.squaredLength }
      .prefix(Self.maximumResiduals)
    var numbers: [UInt16] = []
    for residual in largest {
      let place = (residual.pixel / size).clamped(lowerBound: .zero, upperBound: .one) * 65535
      let offset = (residual.offset * 100).clamped(
        lowerBound: SIMD2(repeating: -32767), upperBound: SIMD2(repeating: 32767))
      numbers.append(UInt16(saturating: place.x))
      numbers.append(UInt16(saturating: place.y))
      numbers.append(UInt16(bitPattern: Int16(saturating: offset.x)))
      numbers.append(UInt16(bitPattern: Int16(saturating: offset.y)))
    }
    self.residuals = Data(littleEndian: numbers)
  }
}
