import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct StrongestChainsTests {
  @Test func weakestLinkOfTheStrongerWay() {
    let chains = StrongestChains(
      photoCount: 6, links: [(9, 0, 1), (4, 1, 2), (7, 0, 3), (5, 3, 2), (8, 4, 5)])
    #expect(chains.weakestLink(between: 0, and: 1) == 9)
    #expect(chains.weakestLink(between: 1, and: 2) == 5)
    #expect(chains.weakestLink(between: 2, and: 3) == 5)
    #expect(chains.weakestLink(between: 3, and: 1) == 7)
    #expect(chains.weakestLink(between: 0, and: 4) == 0)
  }

  /// On random graphs with equal strengths, the strengths are those of an exhaustive relaxation.
  @Test(arguments: 0..<20) func equalsRelaxation(seed: UInt64) {
    var generator = SeededGenerator(seed: seed)
    let count = 12
    let links = (0..<20).map { _ in
      (
        strength: Int.random(in: 1...5, using: &generator),
        first: Int.random(in: 0..<count, using: &generator),
        second: Int.random(in: 0..<count, using: &generator)
      )
    }
    var best = [[Int]](repeating: [Int](repeating: 0, count: count), count: count)
    for link in links {
      let strength = max(best[link.first][link.second], link.strength)
      (best[link.first][link.second], best[link.second][link.first]) = (strength, strength)
    }
    for k in 0..<count {
      for i in 0..<count {
        for j in 0..<count { best[i][j] = max(best[i][j], min(best[i][k], best[k][j])) }
      }
    }
    let chains = StrongestChains(photoCount: count, links: links)
    for i in 0..<count {
      for j in 0..<count where i != j {
        #expect(chains.weakestLink(between: i, and: j) == best[i][j])
      }
    }
  }
}
