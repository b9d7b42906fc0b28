import Foundation
import SceneModel

/// Properties of the camera: its lens, and its automatic exposure from photo to photo.
package struct Photography: Sendable {
  /// Fraction of a pixel's light received by each of its four neighbors: the blur of a good lens.
  /// Chosen.
  package var blur: Float = 0.08
  /// Exposures are distributed evenly up to this number of stops in both directions.
  package var exposureStops: Double = 0
  /// Red and blue drift by up to this fraction relative to green.
  package var whiteBalance: Double = 0
  /// Fraction of the light lost in the corners.
  package var vignetting: Double = 0

  package init() {}

  /// Linear channel gains of photo `index`.
  func gains(_ index: Int, seed: UInt64) -> SIMD3<Float> {
    // The golden ratio separates the values of neighboring photos.
    let place = (Double(index) * 0.618_033_988_749_895 + 0.31).truncatingRemainder(dividingBy: 1)
    var generator = SplitMix64(seed: seed &* 7_368_787 &+ UInt64(index))
    let exposure = pow(2, exposureStops * (2 * place - 1))
    let drift = SIMD2(generator.uniform(), generator.uniform()) * 2 - 1
    let balance = SIMD3(1 + whiteBalance * drift.x, 1, 1 + whiteBalance * drift.y)
    return SIMD3<Float>(balance * exposure)
  }

  /// The fraction of the light that remains at a squared distance from the center, 1 in the
  /// corners.
  func falloff(_ squaredDistance: Double) -> Float { Float(1 - vignetting * squaredDistance) }
}
