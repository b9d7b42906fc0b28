import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct RepetitionSearchTests {
  /// Twenty different features, and noisy copies of the first ten, last first, `distance` pixels to
  /// the right of all of them.
  private func features(copiesAt distance: Float) -> FeatureSet {
    let originals = DescriptorMatchingTests.descriptors(20, seed: 5)
    let copies = DescriptorMatchingTests.noisyCopy(of: originals, 20, seed: 6)
    var set = DescriptorMatchingTests.set(originals + copies[..<(10 * 128)])
    for index in 0..<20 { set.positions[index] = SIMD2(0, Float(index)) }
    for index in 20..<30 { set.positions[index] = SIMD2(distance, Float(39 - index)) }
    return set
  }

  private let search = RepetitionSearch(maximumDistance: 150)

  @Test func copiesAreRepeated() throws {
    let set = features(copiesAt: 100)
    let found = try search.areRepeated(Array(0..<30), of: set, KernelControl())
    // The copies are of the last ten.
    #expect(found == (0..<30).map { $0 >= 10 })
  }

  @Test func onlyTheQueriesAreAnswered() throws {
    let found = try search.areRepeated([29, 3, 15], of: features(copiesAt: 100), KernelControl())
    #expect(found == [true, false, true])
    #expect(try search.areRepeated([], of: features(copiesAt: 100), KernelControl()).isEmpty)
  }

  /// Windows of features with σ = 1 overlap up to a distance of 12 pixels.
  @Test func overlappingFeaturesAreNoRepetition() throws {
    var near = features(copiesAt: 11.9)
    let all = Array(Int32(0)..<30)
    #expect(try !search.areRepeated(all, of: near, KernelControl()).contains(true))
    near.scales = near.scales.map { $0 * 0.9 }
    #expect(try search.areRepeated(all, of: near, KernelControl()).count { $0 } == 20)
  }

  @Test func lessSimilarFeaturesAreNoRepetition() throws {
    let strict = RepetitionSearch(maximumDistance: 20)
    let found = try strict.areRepeated(
      Array(0..<30), of: features(copiesAt: 100), KernelControl())
    #expect(!found.contains(true))
  }

  @Test(arguments: [Int32(-1), 30]) func indicesOutOfRangeThrow(_ index: Int32) throws {
    #expect(throws: KernelError.self) {
      try search.areRepeated([index], of: features(copiesAt: 100), KernelControl())
    }
  }
}
