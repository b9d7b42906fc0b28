import SceneModel

/// Finds the plane of a plain backdrop under the object, by the outlines of shadows on it.
///
/// A white table has no texture of its own. What is reconstructed of it are the outlines of
/// shadows, which have its hue, are level, and have nothing below them.
struct ShadowPlane: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Brightness of a shadow relative to the backdrop, at least. Measured: found on captures of
    /// seed 7 (docs/experiments/2026-11-moving-objects.md).
    var minimumBrightness: Float = 0.25
    /// Maximum difference between the color of a shadow and the darkened backdrop, in each
    /// channel, 0…255. Measured: as above.
    var tolerance: Float = 10
    /// Darker backdrops show no shadows; the brightest channel, 0…255. Chosen.
    var minimumBackdrop: Float = 64
    /// Maximum share of the points that may be below the plane. Measured: found on captures of seed
    /// 7 (docs/experiments/2026-11-moving-objects.md).
    var maximumBelow = 0.02
    /// Number of planes, each below the one before, that are tried: the object has level faces,
    /// too. Chosen.
    var attempts = 4
    var support = SupportPlaneDetection.Options()

    init() {}
  }

  var options = Options()

  /// The plane, and whether each point belongs to a shadow on it; nil if there is none. `colors`
  /// are those of the points, 0…255.
  func run(
    _ cloud: PointCloud, colors: [SIMD3<Float>], backdrop: SIMD3<Float>,
    _ reconstruction: Reconstruction
  ) -> (plane: SupportPlane, isShadow: [Bool])? {
    let hasHue = colors.map { isShade(of: backdrop, $0) }
    guard
      let focus = ViewFocus(reconstruction, depths: reconstruction.medianDepths(of: cloud)),
      let spacing = cloud.medianFootprint
    else { return nil }
    let isUpKnown = reconstruction.worldFrame.up != .unknown
    var candidates = cloud.filtered(by: hasHue)
    for _ in 0..<options.attempts {
      let plane = SupportPlaneDetection(options: options.support).run(
        positions: candidates.positions, normals: candidates.normals,
        up: isUpKnown ? reconstruction.worldFrame.vertical : focus.meanUp,
        isUpKnown: isUpKnown, focus: focus, cell: 2 * Double(spacing))
      guard let plane else { return nil }
      let heights = cloud.positions.map { plane.height(of: SIMD3<Double>($0)) }
      let below = heights.count { $0 < -2 * plane.band }
      if Double(below) <= options.maximumBelow * Double(cloud.count) {
        return (plane, zip(hasHue, heights).map { $0 && abs($1) <= plane.band })
      }
      candidates = candidates.filtered(
        by: candidates.positions.map { plane.height(of: SIMD3<Double>($0)) < -plane.band })
    }
    return nil
  }

  /// Whether a color is the backdrop's, or a darker shade of it.
  private func isShade(of backdrop: SIMD3<Float>, _ color: SIMD3<Float>) -> Bool {
    guard backdrop.max() >= options.minimumBackdrop else { return false }
    let brightness = (color * backdrop).sum() / (backdrop * backdrop).sum()
    let difference = color - brightness * backdrop
    return brightness >= options.minimumBrightness
      && max(difference.max(), -difference.min()) <= options.tolerance
  }
}
