import Foundation
import SceneModel

/// Creates descriptors similar to RootSIFT's, of length 512: each is a mixture of one of a few
/// hundred kinds of texture and an individual part that changes with the view.
struct GrowthDescriptors: Sendable {
  private static let kinds = 256
  private static let share: Float = 0.35
  /// Change of the descriptors with the viewing direction (1 for 90°) and per octave of scale.
  private static let viewGain: Float = 0.25
  private static let scaleGain: Float = 0.1
  private static let noise: Float = 0.05

  /// Long tables that descriptors are slices of: drawing each number individually would take
  /// minutes.
  private let texture, gradients: [Float]

  init(_ random: inout SeededGenerator) {
    texture = (0..<1 << 18).map { _ in Float(random.uniform() * random.uniform()) }
    gradients = (0..<1 << 18).map { _ in Float(random.normal()) }
  }

  /// Appends 128 bytes: the descriptor of point `key` in a view with the given `appearance`.
  func append(
    _ key: UInt64, _ appearance: SIMD3<Float>, to bytes: inout [UInt8],
    _ random: inout SeededGenerator
  ) {
    let length = FeatureSet.descriptorLength
    let kind = Int(key >> 56) % Self.kinds * length
    let own = slice(key)
    let (first, second, third) = (slice(key &* 3), slice(key &* 5), slice(key &* 7))
    let noise = slice(random.next())
    let gains = SIMD3(Self.viewGain, Self.viewGain, Self.scaleGain) * appearance
    withUnsafeTemporaryAllocation(of: Float.self, capacity: length) { values in
      var squares: Float = 0
      for k in 0..<length {
        let base = Self.share * texture[kind + k] + (1 - Self.share) * texture[own + k]
        let change =
          gains.x * gradients[first + k] + gains.y * gradients[second + k]
          + gains.z * gradients[third + k] + Self.noise * gradients[noise + k]
        let value = max(0, base + change)
        values.initializeElement(at: k, to: value)
        squares += value * value
      }
      let factor = 512 / max(squares.squareRoot(), .leastNormalMagnitude)
      for value in values { bytes.append(UInt8(min(255, factor * value))) }
    }
  }

  /// The start of a slice of the tables.
  private func slice(_ key: UInt64) -> Int {
    Int(((key ^ key >> 29) &* 0x9E37_79B9_7F4A_7C15) >> 32)
      % (texture.count - FeatureSet.descriptorLength)
  }
}
