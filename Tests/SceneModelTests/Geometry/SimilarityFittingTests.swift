import SceneModel
import Testing

@Suite struct SimilarityFittingTests {
  private func points(_ count: Int, seed: UInt64) -> [SIMD3<Double>] {
    var random = SplitMix64(seed: seed)
    return (0..<count).map { _ in random.vector(4) }
  }

  @Test(arguments: 1...20) func exactSimilaritiesComeBack(seed: UInt64) throws {
    var random = SplitMix64(seed: seed)
    let truth = SimilarityTransform(
      scale: 0.01 + 10 * random.uniform(), rotation: random.rotation(),
      translation: random.vector(100))
    let source = points(8, seed: 100 + seed)
    let found = try #require(
      SimilarityTransform.fitting(source, to: source.map { truth * $0 }))
    #expect(abs(found.scale / truth.scale - 1) < 1e-12)
    #expect((found.rotation * truth.rotation.conjugate).angle < 1e-7)
    for point in source {
      #expect((found * point - truth * point).length < 1e-11 * truth.scale * 100)
    }
  }

  @Test func mirrorImagesAreNotFittedByAReflection() throws {
    let source = points(10, seed: 3)
    let mirrored = source.map { SIMD3(-$0.x, $0.y, $0.z) }
    let found = try #require(SimilarityTransform.fitting(source, to: mirrored))
    #expect(abs(found.rotation.matrix.determinant - 1) < 1e-12 && found.scale < 0.9)
  }

  /// No similarity nearby has a smaller sum of squared distances.
  @Test func theFitIsAMinimum() throws {
    var random = SplitMix64(seed: 11)
    let source = points(12, seed: 12)
    let truth = SimilarityTransform(
      scale: 1.7, rotation: random.rotation(), translation: [1, 2, 3])
    let target = source.map { truth * $0 + random.vector(0.3) }
    let fit = try #require(SimilarityTransform.fitting(source, to: target))
    func error(_ t: SimilarityTransform) -> Double {
      zip(source, target).reduce(0) { $0 + (t * $1.0 - $1.1).squaredLength }
    }
    let least = error(fit)
    for _ in 0..<200 {
      let step = 0.01 * random.uniform()
      let other = SimilarityTransform(
        scale: fit.scale * (1 + random.number(step)),
        rotation: Quaternion(angle: random.number(step), axis: random.vector()) * fit.rotation,
        translation: fit.translation + random.vector(step))
      #expect(error(other) >= least - 1e-12)
    }
  }

  @Test func degenerateInputHasNoFit() {
    let three = points(3, seed: 1)
    #expect(SimilarityTransform.fitting(Array(three[..<2]), to: Array(three[..<2])) == nil)
    #expect(SimilarityTransform.fitting(three, to: Array(three[..<2])) == nil)
    let same = [SIMD3<Double>](repeating: [1, 2, 3], count: 5)
    #expect(SimilarityTransform.fitting(same, to: points(5, seed: 2)) == nil)
    #expect(SimilarityTransform.fitting(points(5, seed: 2), to: same) == nil)
    #expect(SimilarityTransform.fitting([[.nan, 0, 0]] + three, to: three + [.zero]) == nil)
  }
}
