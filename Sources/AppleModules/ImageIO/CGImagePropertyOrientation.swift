/// How stored pixels are to be turned to stand upright: the EXIF orientation.
public enum CGImagePropertyOrientation: UInt32, Hashable, Sendable {
  /// The first row is the top, the first column the left side.
  case up = 1
  /// Mirrored left to right.
  case upMirrored
  /// Turned by 180°.
  case down
  /// Mirrored top to bottom.
  case downMirrored
  /// Mirrored at the main diagonal.
  case leftMirrored
  /// To be turned by 90° clockwise.
  case right
  /// Mirrored at the other diagonal.
  case rightMirrored
  /// To be turned by 90° counter-clockwise.
  case left
}
