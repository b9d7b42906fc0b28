import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct NearestPointsTests {
  private func points(_ count: Int, seed: UInt64) -> [SIMD3<Float>] {
    var random = SeededGenerator(seed: seed)
    return (0..<count).map { _ in SIMD3<Float>(random.normal3()) }
  }

  /// 40,000 points are in several trees.
  @Test(arguments: [3, 100, 40_000], [1, 4])
  func nearestPointsAreFound(count: Int, neighbors: Int) throws {
    let (points, queries) = (points(count, seed: 1), points(50, seed: 2))
    let reach = 0.4
    let found = try NearestPoints(
      of: queries, in: points, neighbors: neighbors, maximumDistance: reach, KernelControl())
    for (index, query) in queries.enumerated() {
      let expected = points.map { ($0 - query).length }.sorted().prefix(neighbors)
        .filter { $0 <= Float(reach) }
      for k in 0..<neighbors {
        let slot = index * neighbors + k
        if k < expected.count {
          #expect(abs(found.distances[slot] - expected[k]) < 1e-5)
          let point = points[Int(found.indices[slot])]
          #expect(abs((point - query).length - found.distances[slot]) < 1e-5)
        } else {
          #expect(found.indices[slot] == -1)
          #expect(found.distances[slot] == .infinity)
        }
      }
    }
  }

  @Test func resultDoesNotDependOnThreads() throws {
    let (points, queries) = (points(80_000, seed: 3), points(20_000, seed: 4))
    let found = try [1, 2, 3, 8].map {
      try NearestPoints(
        of: queries, in: points, neighbors: 3, KernelControl(threadCount: $0))
    }
    for other in found.dropFirst() {
      #expect(other.indices == found[0].indices)
      #expect(other.distances == found[0].distances)
    }
  }
}
