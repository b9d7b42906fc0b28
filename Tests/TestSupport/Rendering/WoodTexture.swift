import SceneModel

/// Planks with strong grain along the x axis: streaks a few millimeters wide and much longer,
/// slightly bent, and dark pores.
struct WoodTexture: SurfaceTexture {
  private let plankWidth: Float = 0.14
  private let grain: SolidTexture
  private let seed: UInt32

  init(seed: UInt32) {
    self.seed = seed
    var grain = SolidTexture(
      palette: [
        [0.055, 0.027, 0.012], [0.21, 0.115, 0.05], [0.32, 0.19, 0.09], [0.52, 0.36, 0.2],
      ],
      wavelength: 0.014, octaves: 5, seed: seed, contrast: 3.5)
    grain.stretch = [16, 1, 1]
    self.grain = grain
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    let position = point.z / plankWidth
    let plank = position.rounded(.down)
    // Each plank is cut from another place of the tree.
    var place = point + SIMD3(3.17, 1.73, 0) * plank
    let bend = SolidTexture.noise(SIMD3(place.x / 0.4, place.y, place.z / 0.08), seed &+ 1)
    place.z += 0.025 * (bend - 0.5)
    let tint = 0.8 + 0.4 * SolidTexture.noise(SIMD3(0.5, 0.5, plank * 1.37), seed &+ 2)
    let toJoint = (0.5 - abs(position - plank - 0.5)) * plankWidth
    let joint = coverage(toJoint - 0.0008, footprint)
    let dark = (1 - 0.55 * pores(at: place, footprint)) * (1 - 0.8 * joint)
    return grain.color(at: place, footprint: footprint) * (tint * dark)
  }

  /// The fraction of the surface that is pores: dashes 1 mm wide and up to 3 cm long.
  private func pores(at place: SIMD3<Float>, _ footprint: Float) -> Float {
    let width: Float = 0.0018
    let visible = resolved(width, footprint)
    guard visible > 0 else { return 0 }
    let value = SolidTexture.noise(place / SIMD3(0.022, 0.01, width), seed &+ 3)
    return visible * min(max((value - 0.7) / 0.1, 0), 1)
  }
}
