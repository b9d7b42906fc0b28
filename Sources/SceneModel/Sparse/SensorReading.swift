/// What sensors beside the camera told when a photo was taken.
package struct SensorReading: Hashable, Codable, Sendable {
  /// The direction of gravity in the frame of the camera: x right, y down, z forward, of the upright
  /// photo.
  package var gravity: SIMD3<Double>?
  package var depth: DepthMap?

  package init(gravity: SIMD3<Double>? = nil, depth: DepthMap? = nil) {
    self.gravity = gravity
    self.depth = depth
  }
}

extension SensorReading {
  /// The direction of gravity in the frame of the camera, from that in the frame of a phone: x to the
  /// right and y up on its screen, z towards its user. Nil for none.
  ///
  /// `orientation` is how the pixels of the sensor are turned upright, 1…8 as in EXIF: a phone stores
  /// what its camera sees when it is held with its right side up.
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
