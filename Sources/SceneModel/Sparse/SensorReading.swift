/// Readings of other sensors at the time of capture.
package struct SensorReading: Hashable, Codable, Sendable {
  /// The direction of gravity in the camera frame of the upright photo: x right, y down, z forward.
  package var gravity: SIMD3<Double>?
  /// Depths in meters, for the upright photo.
  package var depth: DepthMap?

  package init(gravity: SIMD3<Double>? = nil, depth: DepthMap? = nil) {
    self.gravity = gravity
    self.depth = depth
  }
}

extension SensorReading {
  /// Converts a direction of gravity from the frame of a phone (x right and y up on its screen, z
  /// toward its user) to the camera frame of the upright photo. Nil for a zero or non-finite
  /// vector.
  ///
  /// `orientation`, 1…8 as in EXIF, rotates the sensor pixels upright: a phone stores the sensor
  /// pixels in the orientation that is upright when the phone is held with its right edge up.
  package static func gravity(
    ofPhone gravity: SIMD3<Double>, orientation: Int
  ) -> SIMD3<Double>? {
    guard gravity.squaredLength > 0, gravity.squaredLength.isFinite else { return nil }
    let v = SIMD3(-gravity.y, -gravity.x, -gravity.z)
    return switch orientation {
    case 2: SIMD3(-v.x, v.y, v.z)
    case 3: SIMD3(-v.x, -v.y, v.z)
    case 4: SIMD3(v.x, -v.y, v.z)
    case 5: SIMD3(v.y, v.x, v.z)
    case 6: SIMD3(-v.y, v.x, v.z)
    case 7: SIMD3(-v.y, -v.x, v.z)
    case 8: SIMD3(v.y, -v.x, v.z)
    default: v
    }
  }
}
