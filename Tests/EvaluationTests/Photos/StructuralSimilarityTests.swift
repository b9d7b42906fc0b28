import SceneModel
import Testing

@testable import Evaluation

@Suite struct StructuralSimilarityTests {
  private static let size = 40
  private static let full = [Float](repeating: 1, count: size * size)

  private static func image(_ value: (Int, Int) -> Float) -> [Float] {
    (0..<size * size).map { value($0 % size, $0 / size) }
  }

  private func similarity(_ weights: [Float] = full) -> StructuralSimilarity {
    StructuralSimilarity(width: Self.size, height: Self.size, weights: weights)
  }

  private static let pattern = image { Float(($0 * 7 + $1 * 13) % 17) / 17 }

  @Test func equalImagesHaveOne() {
    #expect(abs(similarity().mean(Self.pattern, Self.pattern) - 1) < 1e-5)
  }

  /// Of constant images only the term of the means is left.
  @Test func constantImagesHaveTheTermOfTheMeans() {
    let (a, b) = (Float(0.5), Float(0.7))
    let expected = Double((2 * a * b + 1e-4) / (a * a + b * b + 1e-4))
    let found = similarity().mean(Self.image { _, _ in a }, Self.image { _, _ in b })
    #expect(abs(found - expected) < 1e-3)
  }

  @Test func invertedPatternsAreNegative() {
    #expect(similarity().mean(Self.pattern, Self.pattern.map { 1 - $0 }) < -0.8)
  }

  @Test func pixelsWithoutWeightDontCount() {
    let weights = Self.image { x, _ in x < 20 ? 1 : 0 }
    var other = Self.pattern
    for index in other.indices where index % Self.size >= 20 { other[index] = 0 }
    #expect(abs(similarity(weights).mean(Self.pattern, other) - 1) < 1e-5)
    #expect(similarity().mean(Self.pattern, other) < 0.7)
    #expect(similarity(Self.image { _, _ in 0 }).mean(Self.pattern, other) == 0)
  }
}
