import ImageIO

extension PhotogrammetrySample {
  /// The direction of gravity in the frame of the camera that the upright photo is from: x right, y
  /// down, z forward. Nil where it isn't known.
  var gravityInCamera: SIMD3<Double>? {
    guard let gravity, (gravity.x * gravity.x + gravity.y * gravity.y + gravity.z * gravity.z) > 0
    else { return nil }
    // A phone stores what its camera sees when it is held with its right side up.
    let stored = SIMD3(-gravity.y, -gravity.x, -gravity.z)
    return Self.turned(stored, upright: storedOrientation)
  }

  private static func turned(
    _ v: SIMD3<Double>, upright orientation: CGImagePropertyOrientation
  ) -> SIMD3<Double> {
    switch orientation {
    case .up: v
    case .upMirrored: SIMD3(-v.x, v.y, v.z)
    case .down: SIMD3(-v.x, -v.y, v.z)
    case .downMirrored: SIMD3(v.x, -v.y, v.z)
    case .leftMirrored: SIMD3(v.y, v.x, v.z)
    case .right: SIMD3(-v.y, v.x, v.z)
    case .rightMirrored: SIMD3(-v.y, -v.x, v.z)
    case .left: SIMD3(v.y, -v.x, v.z)
    }
  }
}
