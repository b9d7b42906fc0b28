import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct ImageRetrievalTests {
  /// Descriptors around `kinds` centers.
  static func descriptors(_ count: Int, kinds: Int, seed: UInt64 = 1) -> [UInt8] {
    var random = SeededGenerator(seed: 7)
    let centers = (0..<kinds).map { _ in (0..<128).map { _ in 80 * random.uniform() } }
    random = SeededGenerator(seed: seed)
    return (0..<count).flatMap { index in
      centers[index % kinds].map { UInt8(max(0, min(255, $0 + random.normal()))) }
    }
  }

  @Test func vectorsHaveUnitLength() throws {
    let descriptors = Self.descriptors(300, kinds: 9)
    let vocabulary = try VisualVocabulary(count: 8, descriptors: descriptors, KernelControl())
    #expect(vocabulary.count == 8)
    let vector = try vocabulary.vector(
      of: DescriptorMatchingTests.set(descriptors), KernelControl())
    #expect(vector.count == 8 * 128)
    #expect(abs(vector.reduce(0) { $0 + $1 * $1 } - 1) < 1e-4)
    let empty = try vocabulary.vector(of: FeatureSet(), KernelControl())
    #expect(empty.allSatisfy { $0 == 0 })
  }

  @Test func vocabularyIsLimitedByItsDescriptors() throws {
    let few = try VisualVocabulary(
      count: 8, descriptors: Self.descriptors(3, kinds: 3), KernelControl())
    #expect(few.count == 3)
    let none = try VisualVocabulary(count: 8, descriptors: [], KernelControl())
    #expect(none.count == 0)
    #expect(try none.vector(of: FeatureSet(), KernelControl()).isEmpty)
  }

  @Test func sameSeedGivesTheSameVectors() throws {
    let descriptors = Self.descriptors(9000, kinds: 40)
    let vectors = try [1, 2].map { threads in
      let control = KernelControl(threadCount: threads)
      return try VisualVocabulary(count: 16, descriptors: descriptors, seed: 5, control)
        .vector(of: DescriptorMatchingTests.set(descriptors), control)
    }
    #expect(vectors[0] == vectors[1])
  }

  @Test func mostSimilarComeFirst() throws {
    let vectors: [Float] = [1, 0, 0.8, 0.6, 0, 1, -1, 0, 0.8, 0.6]
    let ranking = try SimilarityRanking(
      vectors: vectors, photoCount: 5, neighborCount: 3, KernelControl())
    #expect(ranking.neighbors(of: 0) == [1, 4, 2])
    #expect(ranking.neighbors(of: 1) == [4, 0, 2])
    #expect(ranking.neighbors(of: 3) == [2, 1, 4])
    let all = try SimilarityRanking(
      vectors: vectors, photoCount: 5, neighborCount: 9, KernelControl())
    #expect(all.neighborCount == 4 && all.neighbors(of: 2) == [1, 4, 0, 3])
    let one = try SimilarityRanking(vectors: [1], photoCount: 1, neighborCount: 3, KernelControl())
    #expect(one.neighbors(of: 0).isEmpty)
  }
}
