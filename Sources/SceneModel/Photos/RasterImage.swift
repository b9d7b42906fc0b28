/// An 8-bit image in memory: top row first, interleaved channels (1 gray, 3 RGB, 4 RGBA).
package struct RasterImage: Hashable, Sendable {
  package var width: Int
  package var height: Int
  package var channels: Int
  /// `height × width × channels` bytes.
  package var pixels: [UInt8]

  /// `pixels` must have `height × width × channels` bytes.
  package init(width: Int, height: Int, channels: Int, pixels: [UInt8]) {
    precondition(pixels.count == width * height * channels)
    self.width = width
    self.height = height
    self.channels = channels
    self.pixels = pixels
  }

  /// An image with all bytes set to `value`.
  package init(width: Int, height: Int, channels: Int, filledWith value: UInt8 = 0) {
    self.init(
      width: width, height: height, channels: channels,
      pixels: [UInt8](repeating: value, count: width * height * channels))
  }
}
