import Foundation
import ImageFiles
import SceneModel
import TestSupport

extension TemporaryFolder {
  /// Writes `count` photos of noise into a subfolder. They take some time to read and can't be
  /// aligned.
  func writeNoisePhotos(_ count: Int, to name: String) throws {
    for index in 0..<count {
      let (width, height) = (800, 600)
      let pixels = (0..<(width * height * 3)).map { place in
        let cell = place / 3 % width / 6 + place / 3 / width / 6 * 977 + index * 31
        return UInt8(truncatingIfNeeded: (cell &* 2_654_435_761) >> 11)
      }
      let image = RasterImage(width: width, height: height, channels: 3, pixels: pixels)
      try write(ImageCodec.encodeJPEG(image, quality: 0.9), as: "\(name)/p\(index).jpg")
    }
  }
}
