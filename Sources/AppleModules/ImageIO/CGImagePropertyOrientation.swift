/// The EXIF orientation: how the stored pixels relate to the upright image.
public enum CGImagePropertyOrientation: UInt32, Hashable, Sendable {
  /// Row 0 is the top, column 0 the left side.
  case up = 1
  /// Mirrored horizontally.
  case upMirrored
  /// Rotated by 180°.
  case down
  /// Mirrored vertically.
  case downMirrored
  /// Mirrored at the main diagonal.
  case leftMirrored
  /// Upright after a clockwise rotation by 90°.
  case right
  /// Mirrored at the antidiagonal.
  case rightMirrored
  /// Upright after a counterclockwise rotation by 90°.
  case left
}
