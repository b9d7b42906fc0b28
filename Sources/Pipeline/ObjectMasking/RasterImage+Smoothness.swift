import Kernels
import SceneModel

extension RasterImage {
  /// Whether the values of a gray image differ by at most `maximumRange` in the window of three by
  /// three pixels around each pixel.
  func smoothPixels(maximumRange: UInt8) throws -> [Bool] {
    var negative = self
    negative.pixels = pixels.map { 255 - $0 }
    let (highest, lowest) = (try dilated(by: 1).pixels, try negative.dilated(by: 1).pixels)
    return zip(highest, lowest).map { $0 - (255 - $1) <= maximumRange }
  }
}
