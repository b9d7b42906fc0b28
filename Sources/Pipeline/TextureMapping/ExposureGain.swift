import Foundation
import SceneModel

/// Maps a photo's colors to the set's mean exposure.
///
/// Exposure scales light. Except for the darkest tones, sRGB stores a power of the light minus a
/// constant, so a gain acts on the stored value plus that constant.
struct ExposureGain: Hashable, Codable, Sendable {
  /// The constant. Limit: sRGB has 0.055 of 255 (IEC 61966-2-1).
  static let encodingOffset: Float = 0.055 * 255

  /// Gains of red, green and blue.
  var factors: SIMD3<Float>

  static let none = ExposureGain(factors: .one)

  /// Added to a color times the factors.
  var offset: SIMD3<Float> { Self.encodingOffset * (factors - .one) }

  /// The factor on light, of green: sRGB stores about the 2.4th root of light, IEC 61966-2-1.
  var light: Float { pow(factors.y, 2.4) }

  /// A photo color, 0…255, at the mean exposure.
  func apply(_ color: SIMD3<Float>) -> SIMD3<Float> { color * factors + offset }

  /// The inverse of `apply`: the color in the photo.
  func stored(_ color: SIMD3<Float>) -> SIMD3<Float> { (color - offset) / factors }
}
