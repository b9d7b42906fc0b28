import SceneModel

extension PhotogrammetrySample {
  /// The direction of gravity in the camera frame of the upright photo: x right, y down, z forward.
  /// Nil if it isn't known.
  var gravityInCamera: SIMD3<Double>? {
    gravity.flatMap {
      SensorReading.gravity(
        ofPhone: SIMD3($0.x, $0.y, $0.z), orientation: Int(storedOrientation.rawValue))
    }
  }
}
