import SceneModel

/// Estimates the up direction of the scene from the orientations of the cameras.
struct CameraUp: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum length, 0…1, of the mean image top; below it, the cameras look up or down. Chosen.
    var minimumTop = 0.3
    /// Minimum length, 0…1, of the mean backward axis of such cameras. Chosen.
    var minimumBack = 0.1
    /// Maximum mean squared component of the x axes along their common normal. Chosen.
    var maximumNormalVariance = 0.02
    /// Minimum of the second smallest principal value of the x axes: they span a plane. Chosen.
    var minimumSpread = 0.1
    /// Minimum cosine of the angle between their normal and the mean image top. Chosen.
    var minimumCosine = 0.6
    /// Cameras in several orientations are assumed if that reduces the cost of `LevelCameras` by
    /// this: some photos were taken with the camera on its side. Chosen.
    var minimumLevelGain = 0.05
    var level = LevelCameras.Options()
  }

  /// Unit vector in the frame of the reconstruction.
  var direction: SIMD3<Double>
  /// Whether the opposite direction is much less likely.
  var isSignCertain = true

  init(_ reconstruction: Reconstruction, _ options: Options = Options()) {
    let rotations = reconstruction.poses.compactMap { $0?.rotation.conjugate }
    let direction = Self.meanDirection(rotations, options)
    let level = LevelCameras(rotations, options: options.level)
    if let other = level.direction(),
      level.cost(of: other.up) + options.minimumLevelGain < level.cost(of: direction)
    {
      (self.direction, isSignCertain) = other
    } else {
      self.direction = direction
    }
  }

  /// The up direction if this side of all photos was up.
  init(_ reconstruction: Reconstruction, side: ChosenUp.PhotoSide, _ options: Options = Options()) {
    let roll = Quaternion(angle: side.angle, axis: [0, 0, 1])
    let rotations = reconstruction.poses.compactMap { $0.map { $0.rotation.conjugate * roll } }
    direction = Self.meanDirection(rotations, options)
  }

  /// The up direction if all cameras are held upright.
  private static func meanDirection(
    _ rotations: [Quaternion], _ options: Options
  ) -> SIMD3<Double> {
    let mean =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, -1, 0] } / Double(rotations.count)
    let back =
      rotations.reduce(SIMD3<Double>.zero) { $0 + $1 * [0, 0, -1] } / Double(rotations.count)
    // The image tops of downward-looking cameras cancel out; then the backward axes point up.
    guard mean.length > options.minimumTop || mean.length > back.length else {
      return back.length > options.minimumBack ? back.normalized : [0, 1, 0]
    }
    // The x axis of a camera held level is horizontal whatever the viewing direction. If the x axes
    // are spread enough, their common normal is more accurate than the mean of the tilted image
    // tops.
    let axes = rotations.map { $0 * SIMD3<Double>(1, 0, 0) }
    let (values, vectors) = Matrix3(scatterOf: axes, about: .zero).symmetricEigen
    let normal = vectors[0].dot(mean) < 0 ? -vectors[0] : vectors[0]
    if values[0] < options.maximumNormalVariance, values[1] > options.minimumSpread,
      normal.dot(mean.normalized) > options.minimumCosine
    {
      return normal
    }
    return mean.normalized
  }
}
