import SceneModel

/// Finds the plane of a plain backdrop under the object, by the outlines of shadows on it.
///
/// A white table has no texture of its own. What is reconstructed of it are the outlines of
/// shadows, which have its hue, are level, and have nothing below them.
struct ShadowPlane: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Brightness of a shadow relative to the backdrop, at least.
    var minimumBrightness: Float = 0.25
    /// Maximum difference between the color of a shadow and the darkened backdrop, in each channel,
    /// 0…255.
    var tolerance: Float = 16
    /// Darker backdrops show no shadows; the brightest channel, 0…255.
    var minimumBackdrop: Float = 64
    /// Maximum share of the points that may be below the plane.
    var maximumBelow = 0.02
    var support = SupportPlaneDetection.Options()

    init() {}
  }

  var options = Options()

  /// The plane, and whether each point belongs to a shadow on it; nil if there is none.
  func run(
    _ cloud: PointCloud, backdrop: SIMD3<Float>, _ reconstruction: Reconstruction
  ) -> (plane: SupportPlane, isShadow: [Bool])? {
    let hasHue = cloud.colors.map { isShade(of: backdrop, $0) }
    let shades = cloud.filtered(by: hasHue)
    let depths = reconstruction.medianDepths(of: cloud)
    guard let spacing = shades.medianFootprint,
      let focus = ViewFocus(reconstruction, depths: depths)
    else { return nil }
    let isUpKnown = reconstruction.worldFrame.up != .unknown
    let found = SupportPlaneDetection(options: options.support).run(
      positions: shades.positions, normals: shades.normals, up: isUpKnown ? [0, 1, 0] : focus.meanUp,
      isUpKnown: isUpKnown, focus: focus, cell: 2 * Double(spacing))
    guard let plane = found else { return nil }
    let heights = cloud.positions.map { plane.height(of: SIMD3<Double>($0)) }
    let below = heights.count { $0 < -2 * plane.band }
    guard Double(below) <= options.maximumBelow * Double(cloud.count) else { return nil }
    return (plane, zip(hasHue, heights).map { $0 && abs($1) <= plane.band })
  }

  /// Whether a color is the backdrop's, or a darker shade of it.
  private func isShade(of backdrop: SIMD3<Float>, _ color: SIMD3<UInt8>) -> Bool {
    guard backdrop.max() >= options.minimumBackdrop else { return false }
    let color = SIMD3<Float>(color)
    let brightness = (color * backdrop).sum() / (backdrop * backdrop).sum()
    let difference = color - brightness * backdrop
    return brightness >= options.minimumBrightness
      && max(difference.max(), -difference.min()) <= options.tolerance
  }
}
