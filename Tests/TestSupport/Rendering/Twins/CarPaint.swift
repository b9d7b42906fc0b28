import Foundation
import SceneModel

/// The paint of a toy car: two colors, stripes, a number in a disc, scratches, and painted
/// highlights that look like gloss, although the surface is Lambertian. All values were chosen.
struct CarPaint: SurfaceTexture {
  private let lower: SIMD3<Float>
  private let upper: SIMD3<Float>
  private let stripe: SIMD3<Float>
  /// Height at which the colors change.
  private let border: Float
  /// Middle and half width of the stripes along the roof.
  private let stripes: SIMD2<Float>
  private let disc: SIMD2<Float>
  /// The segments of a digit, as in a display.
  private let digit: [SIMD4<Float>]
  private let flakes: SolidTexture
  private let seed: UInt32

  init(_ random: inout TwinRandom) {
    lower = random.color(random.value(0.16, 0.34), saturation: 0.85)
    upper = random.color(random.value(0.3, 0.5), saturation: 0.6)
    stripe = random.chance(0.5) ? [0.72, 0.7, 0.66] : [0.04, 0.04, 0.045]
    border = random.value(0.015, 0.02)
    stripes = [random.value(0.004, 0.008), random.value(0.0015, 0.003)]
    disc = [random.value(-0.016, 0.0), random.value(0.0045, 0.006)]
    let segments: [SIMD4<Float>] = [
      [-1, 2, 1, 2], [1, 2, 1, 0], [1, 0, 1, -2], [-1, -2, 1, -2], [-1, 0, -1, -2], [-1, 2, -1, 0],
      [-1, 0, 1, 0],
    ]
    let digits = [[0, 1, 6, 4, 3], [0, 1, 6, 2, 3], [5, 6, 1, 2], [0, 5, 6, 2, 3], [0, 1, 2]]
    digit = random.one(of: digits).map { segments[$0] }
    seed = random.number()
    flakes = SolidTexture(
      palette: [SIMD3(repeating: 0.8), SIMD3(repeating: 1), SIMD3(repeating: 1.18)],
      wavelength: 0.012, octaves: 5, seed: seed &+ 1, contrast: 1.4
    ).withContrast(0.45)
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    func mix(_ color: inout SIMD3<Float>, _ other: SIMD3<Float>, _ share: Float) {
      color += (other - color) * min(max(share, 0), 1)
    }
    let wave = 0.0006 * sin(point.z * 240)
    var color = lower
    mix(&color, upper, coverage(border + wave - point.y, footprint))
    mix(&color, stripe, coverage(abs(point.y - border - 0.0018) - 0.0005, footprint))
    let onTop = coverage(0.0225 - point.y, 0.001)
    mix(&color, stripe, onTop * coverage(abs(abs(point.x) - stripes.x) - stripes.y, footprint))
    if abs(point.x) > 0.018 { badge(&color, at: point, footprint) }
    color *= flakes.color(at: point, footprint: footprint)
    mix(&color, SIMD3(repeating: 0.85), 0.5 * highlight(at: point))
    mix(&color, SIMD3(repeating: 0.3), 0.7 * scratches(at: point, footprint))
    return color
  }

  /// A number in a light disc on both doors.
  private func badge(_ color: inout SIMD3<Float>, at point: SIMD3<Float>, _ footprint: Float) {
    let offset = SIMD2((point.z - disc.x) * (point.x > 0 ? -1 : 1), point.y - 0.0165)
    let inside = coverage(offset.length - disc.y, footprint)
    guard inside > 0 else { return }
    color += (SIMD3(0.74, 0.73, 0.7) - color) * inside
    let unit = disc.y * 0.32
    let nearest =
      digit.map { segment -> Float in
        let (a, b) = (SIMD2(segment.x, segment.y) * unit, SIMD2(segment.z, segment.w) * unit)
        let t = min(max((offset - a).dot(b - a) / (b - a).squaredLength, 0), 1)
        return (offset - a - (b - a) * t).length
      }.min() ?? 1
    color += (SIMD3(0.03, 0.03, 0.05) - color) * (inside * coverage(nearest - 0.0005, footprint))
  }

  /// Soft bands below the upper edges, as reflections of a window.
  private func highlight(at point: SIMD3<Float>) -> Float {
    let height = (point.y - 0.0215 - 0.0008 * sin(point.z * 130)) / 0.0011
    let interruption = min(max(sin(point.z * 95 + 1) * 2, 0), 1)
    return exp(-height * height) * (abs(point.x) > 0.019 ? interruption : 0)
  }

  private func scratches(at point: SIMD3<Float>, _ footprint: Float) -> Float {
    let turned = SIMD3(point.x, 0.8 * point.y + 0.6 * point.z, 0.8 * point.z - 0.6 * point.y)
    let value = SolidTexture.noise(turned / SIMD3(0.004, 0.0007, 0.009), seed &+ 2)
    let region = SolidTexture.noise(point / 0.011, seed &+ 3)
    return region > 0.55 ? min(max((value - 0.84) / 0.06, 0), 1) : 0
  }
}
