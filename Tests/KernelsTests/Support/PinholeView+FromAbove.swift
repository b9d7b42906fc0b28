import SceneModel

extension PinholeView {
  /// A square photo taken at (0, 0, `distance`) along −z; its focal length is its side.
  static func fromAbove(_ image: RasterImage, distance: Double) -> PinholeView {
    let rotation = Quaternion(x: 1, y: 0, z: 0, w: 0)
    return PinholeView(
      photo: ID(0), image: image,
      camera: Camera(
        width: image.width, height: image.height, focalLength: SIMD2(repeating: Double(image.width))
      ),
      cameraFromWorld: RigidTransform(
        rotation: rotation, translation: -(rotation * SIMD3<Double>(0, 0, distance))))
  }
}
