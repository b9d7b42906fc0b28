import Foundation
import SceneModel

/// A map of texture coordinates: scaled, then rotated counterclockwise, then moved.
struct TextureTransform: Equatable {
  var scale = SIMD2<Float>(1, 1)
  /// Radians.
  var angle: Float = 0
  var offset = SIMD2<Float>.zero

  static let identity = TextureTransform()

  static func * (map: TextureTransform, point: SIMD2<Float>) -> SIMD2<Float> {
    let p = map.scale * point
    let (c, s) = (cos(map.angle), sin(map.angle))
    return SIMD2(c * p.x - s * p.y, s * p.x + c * p.y) + map.offset
  }
}
