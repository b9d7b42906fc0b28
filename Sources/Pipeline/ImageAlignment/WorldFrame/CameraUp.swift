import SceneModel

/// Estimates the up direction of the scene from the orientations of the cameras.
struct CameraUp: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum length, 0…1, of the mean image top; below it, the cameras look up or down.
    var minimumTop = 0.3
    /// Minimum length, 0…1, of the mean backward axis of such cameras.
    var minimumBack = 0.1
    /// Maximum mean squared component of the x axes along their common normal.
    var maximumNormalVariance = 0.02
    /// Minimum of the second smallest principal value of the x axes: they span a plane.
    var minimumSpread = 0.1
    /// Minimum cosine of the angle between their normal and the mean image top.
    var minimumCosine = 0.6
  }

  /// Unit vector in the frame of the reconstruction.
  var direction: SIMD3<Double>

  init(_ reconstruction: Reconstruction, _ options: Options = Options()) {
    let rotations = reconstruction.poses.compactMap { $0?.rotation.conjugate }
    let mean =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, -1, 0] } / Double(rotations.count)
    let back =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, 0, -1] } / Double(rotations.count)
    // The image tops of downward-looking cameras cancel out; then the backward axes point up.
    guard mean.length > options.minimumTop || mean.length > back.length else {
      direction = back.length > options.minimumBack ? back.normalized : [0, 1, 0]
      return
    }
    direction = mean.normalized
    // The x axis of a camera held level is horizontal whatever the viewing direction. If the x axes
    // are spread enough, their common normal is more accurate than the mean of the tilted image
    // tops.
    let axes = rotations.map { $0 * SIMD3<Double>(1, 0, 0) }
    let (values, vectors) = Matrix3(scatterOf: axes, about: .zero).symmetricEigen
    let normal = vectors[0].dot(mean) < 0 ? -vectors[0] : vectors[0]
    if values[0] < options.maximumNormalVariance, values[1] > options.minimumSpread,
      normal.dot(direction) > options.minimumCosine
    {
      direction = normal
    }
  }
}
