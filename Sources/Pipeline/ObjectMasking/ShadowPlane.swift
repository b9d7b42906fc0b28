import SceneModel

/// Finds the planes of a plain backdrop that an object stood on, by the outlines of shadows.
///
/// A white table has no texture of its own. What is reconstructed of it are the outlines of
/// shadows, which have its hue, are level, face the object, and have nothing behind them. If the
/// object was turned over, there are two such planes.
struct ShadowPlane: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Brightness of a shadow relative to the backdrop, at least.
    var minimumBrightness: Float = 0.25
    /// Maximum difference between the color of a shadow and the darkened backdrop, in each
    /// channel, 0…255.
    var tolerance: Float = 10
    /// Darker backdrops show no shadows; the brightest channel, 0…255.
    var minimumBackdrop: Float = 64
    /// Maximum share of the points that may be below the plane.
    var maximumBelow = 0.02
    /// Minimum share of the cameras that must be above a plane: those of one of two placements.
    var minimumCamerasAbove = 0.25
    /// Number of planes, each below the one before, that are tried: the object has level faces,
    /// too.
    var attempts = 4
    var support = SupportPlaneDetection.Options()

    init() {}
  }

  var options = Options()

  /// The first plane, and whether each point belongs to a shadow on one of them; nil if there is
  /// none. `colors` are those of the points, 0…255.
  func run(
    _ cloud: PointCloud, colors: [SIMD3<Float>], backdrop: SIMD3<Float>,
    _ reconstruction: Reconstruction
  ) -> (plane: SupportPlane, isShadow: [Bool])? {
    let hasHue = colors.map { isShade(of: backdrop, $0) }
    guard let focus = ViewFocus(reconstruction, depths: reconstruction.medianDepths(of: cloud))
    else { return nil }
    let isUpKnown = reconstruction.worldFrame.up != .unknown
    let up = isUpKnown ? reconstruction.worldFrame.vertical : focus.meanUp
    let planes = [up, -up].compactMap { up in
      plane(cloud, hasHue, focus, up: up, isUpKnown: isUpKnown)
    }
    guard let first = planes.first else { return nil }
    let minimumCosine = options.support.minimumNormalCosine
    let isShadow = cloud.positions.indices.map { index in
      let (position, normal) = (
        SIMD3<Double>(cloud.positions[index]), SIMD3<Double>(cloud.normals[index])
      )
      // What lies on the plane has the opposite normal.
      return hasHue[index]
        && planes.contains {
          abs($0.height(of: position)) <= $0.band && normal.dot($0.normal) > minimumCosine
        }
    }
    return (first, isShadow)
  }

  /// The plane whose normal is near `up`.
  private func plane(
    _ cloud: PointCloud, _ hasHue: [Bool], _ focus: ViewFocus, up: SIMD3<Double>, isUpKnown: Bool
  ) -> SupportPlane? {
    guard let spacing = cloud.medianFootprint else { return nil }
    var support = options.support
    support.minimumCamerasAbove = options.minimumCamerasAbove
    var candidates = cloud.filtered(by: hasHue)
    for _ in 0..<options.attempts {
      let plane = SupportPlaneDetection(options: support).run(
        positions: candidates.positions, normals: candidates.normals, up: up,
        isUpKnown: isUpKnown, focus: focus, cell: 2 * Double(spacing))
      guard let plane else { return nil }
      let below = cloud.positions.count {
        plane.height(of: SIMD3<Double>($0)) < -2 * plane.band
      }
      if Double(below) <= options.maximumBelow * Double(cloud.count) { return plane }
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
