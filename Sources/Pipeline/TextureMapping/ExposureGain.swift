import SceneModel

/// What takes a photo's colours to those it would have at the set's mean exposure.
///
/// Exposure scales light. sRGB stores a power of the light less a constant, but for its darkest
/// tones, so a gain acts on the stored value plus that constant.
struct ExposureGain: Hashable, Sendable {
  /// The constant, IEC 61966-2-1: 0.055 of 255.
  static let foot: Float = 0.055 * 255

  /// Factors of red, green and blue.
  var factors: SIMD3<Float>

  static let none = ExposureGain(factors: .one)

  /// What is added to a colour times the factors.
  var offset: SIMD3<Float> { Self.foot * (factors - .one) }

  /// A colour of the photo, 0…255, at the mean exposure.
  func apply(_ color: SIMD3<Float>) -> SIMD3<Float> { color * factors + offset }

  /// The colour of the photo again.
  func stored(_ color: SIMD3<Float>) -> SIMD3<Float> { (color - offset) / factors }
}
