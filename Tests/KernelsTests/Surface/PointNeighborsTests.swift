import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct PointNeighborsTests {
  /// 40,000 points are sorted on several threads.
  @Test(arguments: [1, 5, 100, 40_000], [false, true])
  func neighborsAreThoseOfTheNearestSearch(count: Int, areOnALine: Bool) throws {
    var random = SeededGenerator(seed: 7)
    var points = (0..<count).map { index in
      areOnALine
        ? SIMD3<Float>(0.1 * Float(index), 0.05 * Float(random.uniform()), 0)
        : SIMD3<Float>(random.normal3())
    }
    let radii = (0..<count).map { _ in Float(0.01 + 0.49 * random.uniform()) }
    points[count / 2].y = .nan
    let found = try [1, 3].map {
      try PointNeighbors.atLeast(
        4, of: points, within: radii, KernelControl(threadCount: $0))
    }
    let nearest = try NearestPoints(of: points, in: points, neighbors: 5, KernelControl())
    #expect(found[0] == (0..<count).map { nearest.distances[5 * $0 + 4] <= radii[$0] })
    #expect(found[1] == found[0])
    let finite = try PointNeighbors.atLeast(0, of: points, within: radii, KernelControl())
    #expect(finite == points.map(\.isFinite))
  }

  /// Points whose cells have the same key since they are 2²¹ cells apart are no neighbors, nor are
  /// many cells looked at for a radius among much smaller ones.
  @Test(arguments: [1, 2, 4] as [Float])
  func distanceDecides(cellsPerRadius: Float) throws {
    let period = Float(1 << 21) * cellsPerRadius
    let points: [SIMD3<Float>] = [.zero, [period, 0, 0], [0, -period, 0], [0.5, 0, 0]]
    let radii: [Float] = [1, 1, 1, 1]
    let found = try PointNeighbors.atLeast(1, of: points, within: radii, KernelControl())
    #expect(found == [true, false, false, true])
    let wide = try PointNeighbors.atLeast(
      3, of: points, within: [1, 3 * period, 1e30, .infinity], KernelControl())
    #expect(wide == [false, true, true, true])
  }

  @Test func numbersMustAgree() throws {
    #expect(throws: KernelError.self) {
      try PointNeighbors.atLeast(1, of: [.zero], within: [], KernelControl())
    }
    #expect(try PointNeighbors.atLeast(1, of: [], within: [], KernelControl()).isEmpty)
  }
}
