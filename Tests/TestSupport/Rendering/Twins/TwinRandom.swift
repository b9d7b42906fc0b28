import SceneModel

/// The choices that make each seed another object of the same kind.
struct TwinRandom {
  private var generator: SeededGenerator

  init(seed: UInt64) { generator = SeededGenerator(seed: seed) }

  mutating func next() -> UInt64 { generator.next() }

  mutating func number() -> UInt32 { UInt32(truncatingIfNeeded: generator.next()) }

  mutating func value(_ low: Float, _ high: Float) -> Float {
    low + (high - low) * Float(generator.uniform())
  }

  mutating func double(_ low: Double, _ high: Double) -> Double {
    low + (high - low) * generator.uniform()
  }

  /// A value between −`limit` and `limit`.
  mutating func within(_ limit: Double) -> Double { double(-limit, limit) }

  /// A vector with components between −`limit` and `limit`.
  mutating func vector(_ limit: Float) -> SIMD3<Float> {
    let (x, y, z) = (value(-limit, limit), value(-limit, limit), value(-limit, limit))
    return [x, y, z]
  }

  mutating func one<Element>(of elements: [Element]) -> Element {
    elements[generator.below(elements.count)]
  }

  mutating func chance(_ probability: Double) -> Bool { generator.uniform() < probability }

  /// A color of a hue; `saturation` 0 is gray, and the mean of the channels is `lightness`.
  mutating func color(_ lightness: Float, saturation: Float) -> SIMD3<Float> {
    let tint = SIMD3(value(0, 1), value(0, 1), value(0, 1))
    let spread = tint - tint.sum() / 3
    let strength = max(absoluteMaximum(spread), 1e-3)
    let color = lightness * (1 + saturation * spread / strength)
    return color.clamped(lowerBound: .zero, upperBound: SIMD3(repeating: 0.9))
  }

  /// Colors of about the same hue, one per lightness.
  mutating func tones(_ lightness: [Float], saturation: Float) -> [SIMD3<Float>] {
    let hue = color(0.5, saturation: saturation) / 0.5
    return lightness.map { hue * color($0, saturation: 0.25 * saturation) }
  }

  private func absoluteMaximum(_ v: SIMD3<Float>) -> Float { max(v.max(), -v.min()) }
}
