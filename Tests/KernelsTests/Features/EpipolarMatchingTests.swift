import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct EpipolarMatchingTests {
  /// A camera that moved to the right: epipolar lines are rows. `E = [t]ₓ` with t = (1, 0, 0).
  private static let rows = Matrix3(rows: [0, 0, 0], [0, 0, -1], [0, 1, 0])

  /// Sixty points, each on a separate row; the second half repeats the descriptors of the first
  /// half.
  private func repetitive() -> (first: FeatureSet, second: FeatureSet, points: [SIMD2<Double>]) {
    let half = DescriptorMatchingTests.descriptors(30, seed: 3)
    let points = (0..<60).map { SIMD2(Double($0 % 7) * 0.01, Double($0) * 0.01) }
    let set = DescriptorMatchingTests.set(half + half)
    return (set, set, points)
  }

  private func matches(
    _ first: FeatureSet, _ second: FeatureSet, _ points: [SIMD2<Double>],
    except taken: [Int32] = []
  ) throws -> [FeatureMatch] {
    try EpipolarMatching().matches(
      .init(first, points: points, except: taken),
      .init(second, points: points.map { $0 - SIMD2(0.1, 0) }, except: taken), matrix: Self.rows,
      KernelControl())
  }

  @Test func ratioTestIgnoresFeaturesOffTheLine() throws {
    let (first, second, points) = repetitive()
    #expect(try DescriptorMatching().matches(first, second, KernelControl()).isEmpty)
    let found = try matches(first, second, points)
    #expect(Set(found) == Set((0..<60).map { FeatureMatch(first: $0, second: $0) }))
  }

  @Test func takenFeaturesAreExcluded() throws {
    let (first, second, points) = repetitive()
    let found = try matches(first, second, points, except: [0, 7, 59])
    #expect(found.count == 57)
    #expect(found.allSatisfy { $0.first == $0.second && ![0, 7, 59].contains($0.first) })
  }

  @Test func featuresOffTheLineDoNotMatch() throws {
    let (first, second, points) = repetitive()
    let shifted = points.map { $0 + SIMD2(0, 0.004) }
    let found = try EpipolarMatching().matches(
      .init(first, points: points, except: []), .init(second, points: shifted, except: []),
      matrix: Self.rows, KernelControl())
    #expect(found.isEmpty)
  }

  @Test func emptySetsHaveNoMatches() throws {
    let (first, _, points) = repetitive()
    #expect(try matches(FeatureSet(), first, points).isEmpty)
    #expect(try matches(first, FeatureSet(), points).isEmpty)
  }
}
