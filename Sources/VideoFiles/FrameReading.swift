/// What is known about a frame of a video before frames are selected.
package struct FrameReading: Hashable, Sendable {
  /// The number of the frame among those that can be decoded, from 0.
  package var index: Int
  /// Presentation time in seconds.
  package var seconds: Double
  /// How far the picture has moved since the first frame, as a share of its diagonal: the length
  /// of the camera's path as it appears in the picture.
  package var position: Double
  /// `RasterImage.sharpness()`; 0 without texture.
  package var sharpness: Double

  package init(index: Int, seconds: Double, position: Double, sharpness: Double) {
    self.index = index
    self.seconds = seconds
    self.position = position
    self.sharpness = sharpness
  }
}
