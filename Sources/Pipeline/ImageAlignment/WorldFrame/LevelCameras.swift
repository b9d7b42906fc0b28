import SceneModel

/// Estimates the up direction from cameras that are held level, in landscape or portrait
/// orientation, even if the photos don't record which: one of the two image axes is horizontal.
struct LevelCameras: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Number of hypotheses, each from the horizontal axes of two photos. Chosen.
    var iterations = 400
    /// Two horizontal axes must differ by an angle with at least this sine. Chosen.
    var minimumSine = 0.3
    /// Cameras whose optical axis has at least this cosine with the vertical look up or down: their
    /// image axes are all horizontal. Chosen: 20° about the vertical.
    var verticalCosine = 0.94
    /// Cost of a photo that was taken with the camera on its side, in the unit of `cost(of:)`: both
    /// explanations are equally good if all photos have the same direction. Chosen.
    var sideCost = 0.02
    /// If fewer than this share of the photos are upright, the sign follows from the cameras'
    /// looking down. Chosen.
    var minimumUprightShare = 0.2
    /// The sign is certain if cameras look down by an angle with at least this sine, on average.
    /// Chosen.
    var minimumDownwardSine = 0.1
    var seed: UInt64 = 0x5eed_0002

    init() {}
  }

  var options = Options()
  private let right: [SIMD3<Double>]
  private let top: [SIMD3<Double>]
  private let back: [SIMD3<Double>]

  /// `rotations` are those from the cameras to the world.
  init(_ rotations: [Quaternion], options: Options = Options()) {
    self.options = options
    right = rotations.map { $0 * [1, 0, 0] }
    top = rotations.map { $0 * [0, -1, 0] }
    back = rotations.map { $0 * [0, 0, -1] }
  }

  /// How well a direction agrees with level cameras: the mean squared sine of the image axes' tilt,
  /// plus the cost of cameras on their side. 0 is perfect.
  func cost(of up: SIMD3<Double>) -> Double {
    let sum = right.indices.reduce(0) { sum, photo in
      guard abs(back[photo].dot(up)) < options.verticalCosine else { return sum + 0.5 }
      let (x, y) = (right[photo].dot(up), top[photo].dot(up))
      return sum + min(x * x, y * y + options.sideCost)
    }
    return sum / Double(max(1, right.count))
  }

  /// The direction with the lowest cost, and whether it may as well be the opposite one; nil if the
  /// photos don't determine one.
  func direction() -> (up: SIMD3<Double>, isSignCertain: Bool)? {
    guard right.count >= 2 else { return nil }
    var random = SplitMix64(seed: options.seed)
    var best: (up: SIMD3<Double>, cost: Double)?
    for _ in 0..<options.iterations {
      let axes = (0..<2).map { _ in
        let photo = random.below(right.count)
        return random.below(2) == 0 ? right[photo] : top[photo]
      }
      let normal = axes[0].cross(axes[1])
      guard normal.length > options.minimumSine else { continue }
      let up = normal.normalized
      let cost = cost(of: up)
      if cost < best?.cost ?? .infinity { best = (up, cost) }
    }
    guard var up = best?.up else { return nil }
    for _ in 0..<4 { up = refined(up) }
    let vote = upVote(for: up)
    return (vote.score < 0 ? -up : up, vote.isCertain)
  }

  /// The common normal of the image axes that are horizontal if `up` is nearly right.
  private func refined(_ up: SIMD3<Double>) -> SIMD3<Double> {
    let axes = right.indices
      .filter { abs(back[$0].dot(up)) < options.verticalCosine }
      .map { isUpright($0, up) ? right[$0] : top[$0] }
    let normal = Matrix3(scatterOf: axes, about: .zero).symmetricEigen.vectors[0]
    return normal.dot(up) < 0 ? -normal : normal
  }

  /// Whether a camera is held so that its x axis is horizontal.
  private func isUpright(_ photo: Int, _ up: SIMD3<Double>) -> Bool {
    let (x, y) = (right[photo].dot(up), top[photo].dot(up))
    return x * x <= y * y + options.sideCost
  }

  /// A score that is negative if the cameras are upside down or look up.
  private func upVote(for up: SIMD3<Double>) -> (score: Double, isCertain: Bool) {
    let upright = right.indices.filter { isUpright($0, up) }
    guard Double(upright.count) >= options.minimumUprightShare * Double(right.count) else {
      let downward = back.reduce(0.0) { $0 + $1.dot(up) } / Double(max(1, back.count))
      return (downward, abs(downward) >= options.minimumDownwardSine)
    }
    return (upright.reduce(0.0) { $0 + top[$1].dot(up) }, true)
  }
}
