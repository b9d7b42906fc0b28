import SceneModel

extension NamedCamera {
  /// The camera's center, and the direction of the ray through the center of a pixel, in the world.
  func ray(
    throughColumn column: Int, row: Int
  ) -> (origin: SIMD3<Float>, direction: SIMD3<Float>) {
    let point = camera.unproject([Double(column) + 0.5, Double(row) + 0.5])
    let direction = cameraFromWorld.rotation.conjugate * SIMD3(point.x, point.y, 1)
    return (SIMD3<Float>(cameraFromWorld.center), SIMD3<Float>(direction))
  }
}
