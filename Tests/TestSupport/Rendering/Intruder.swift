import Foundation
import SceneModel

/// Something that gets between camera and object in some photos, at another place in each of them:
/// a ball, as somebody's hand or a passer-by would. It is lit from the camera and casts no shadow.
package struct Intruder: Sendable {
  /// The first photo that shows it, and how many photos later the next one does.
  package var first = 1
  package var period = 3
  /// In metres, as all that follows.
  package var radius: Float = 0.03
  /// Distance of its centre from the camera's plane.
  package var depth: Float = 0.38
  /// How far its centre is from the camera's axis at most, to the sides and up or down.
  package var reach: SIMD2<Float> = [0.035, 0.06]
  package var texture = SolidTexture(
    palette: [[0.02, 0.06, 0.30], [0.05, 0.16, 0.62], [0.16, 0.36, 0.80]], wavelength: 0.02,
    octaves: 4, seed: 5)

  package init() {}

  /// Where its centre is in the camera frame of a photo; nil where the photo doesn't show it.
  func center(in photo: Int) -> SIMD3<Float>? {
    guard photo >= first, (photo - first).isMultiple(of: period) else { return nil }
    // Two irrational steps spread the places over the picture.
    let number = Double((photo - first) / period)
    let place = SIMD2(
      (number * 0.754_877_666 + 0.3).truncatingRemainder(dividingBy: 1),
      (number * 0.569_840_291 + 0.6).truncatingRemainder(dividingBy: 1))
    let offset = SIMD2<Float>(2 * place - 1) * reach
    return [offset.x, offset.y, depth]
  }

  /// What a ray of depth 1 in the camera frame sees of it.
  func sight(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, center: SIMD3<Float>,
    footprint: Float
  ) -> RenderedScene.Sight? {
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
    return RenderedScene.Sight(
      radiance: color * (0.35 + 0.5 * facing), depth: depth, normal: normal,
      surface: RenderedScene.Sight.intruder, isLit: true)
  }
}
