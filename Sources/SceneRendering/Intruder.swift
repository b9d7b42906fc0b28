import Foundation
import SceneModel

/// A transient occluder between the camera and the object in some photos, at a different position
/// in each of them: a ball, in place of a hand or a passer-by. It is lit from the camera and casts
/// no shadow. All values were chosen.
package struct Intruder: Sendable {
  /// The first photo that shows it, and the interval to the next one. Chosen.
  package var first = 1
  package var period = 3
  /// Radius in meters. Chosen.
  package var radius: Float = 0.03
  /// Depth of its center in the camera frame, in meters. Chosen.
  package var depth: Float = 0.38
  /// Maximum horizontal and vertical distance of its center from the optical axis, in meters.
  /// Chosen.
  package var reach: SIMD2<Float> = [0.035, 0.06]
  package var texture = SolidTexture(
    palette: [[0.02, 0.06, 0.30], [0.05, 0.16, 0.62], [0.16, 0.36, 0.80]], wavelength: 0.02,
    octaves: 4, seed: 5)

  package init() {}

  /// Its center in the camera frame of a photo; nil if the photo doesn't show it.
  func center(in photo: Int) -> SIMD3<Float>? {
    guard photo >= first, (photo - first).isMultiple(of: period) else { return nil }
    // Two irrational steps distribute the positions over the image.
    let number = Double((photo - first) / period)
    let place = SIMD2(
      (number * 0.754_877_666 + 0.3).truncatingRemainder(dividingBy: 1),
      (number * 0.569_840_291 + 0.6).truncatingRemainder(dividingBy: 1))
    let offset = SIMD2<Float>(2 * place - 1) * reach
    return [offset.x, offset.y, depth]
  }

  /// Its appearance along a ray of depth 1 in the camera frame; nil if the ray misses it.
  func sight(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, center: SIMD3<Float>,
    footprint: Float
  ) -> Sight? {
    let toCenter = center - origin
    let squared = direction.squaredLength
    let closest = toCenter.dot(direction) / squared
    let miss = (toCenter - direction * closest).squaredLength
    guard closest > 0, miss < radius * radius else { return nil }
    let depth = closest - ((radius * radius - miss) / squared).squareRoot()
    let normal = (origin + direction * depth - center) / radius
    let facing = abs(normal.dot(direction.normalized))
    let color = texture.color(
      at: normal * radius, footprint: footprint * depth / max(0.2, facing))
    return Sight(
      radiance: color * (0.35 + 0.5 * facing), depth: depth, normal: normal,
      surface: Sight.intruder, isLit: true)
  }
}
