import SceneModel

/// Estimates the up direction of the scene from the orientations of the cameras.
struct CameraUp: Sendable {
  /// Unit vector in the frame of the reconstruction.
  var direction: SIMD3<Double>

  init(_ reconstruction: Reconstruction) {
    let rotations = reconstruction.poses.compactMap { $0?.rotation.conjugate }
    let mean =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, -1, 0] } / Double(rotations.count)
    let back =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, 0, -1] } / Double(rotations.count)
    // The image tops of downward-looking cameras cancel out; then the backward axes point up.
    guard mean.length > 0.3 || mean.length > back.length else {
      direction = back.length > 0.1 ? back.normalized : [0, 1, 0]
      return
    }
    direction = mean.normalized
    // The x axis of a camera held level is horizontal whatever the viewing direction. If the x axes
    // are spread enough, their common normal is more accurate than the mean of the tilted image
    // tops.
    let axes = rotations.map { $0 * SIMD3<Double>(1, 0, 0) }
    let (values, vectors) = Matrix3(scatterOf: axes, about: .zero).symmetricEigen
    let normal = vectors[0].dot(mean) < 0 ? -vectors[0] : vectors[0]
    if values[0] < 0.02, values[1] > 0.1, normal.dot(direction) > 0.6 { direction = normal }
  }
}
