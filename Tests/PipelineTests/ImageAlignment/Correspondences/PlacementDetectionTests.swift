import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

@Suite struct PlacementDetectionTests {
  private let detection = PlacementDetection()

  // MARK: Intervals

  /// Without agreement within the placements, with some, and with a little contradiction.
  @Test(arguments: [0, 20, -1]) func twoPlacementsAreIntervals(agreementWithin: Int) throws {
    let links = links(12) { ($0 < 5) == ($1 < 5) ? agreementWithin : -50 }
    #expect(try detection.groups(links, photoCount: 12).groups == [Array(5...11), Array(0...4)])
  }

  /// Whether or not the last placement is the first one again.
  @Test(arguments: [0, 10, -50]) func threePlacementsAreIntervals(agreementOfReturn: Int) throws {
    let links = links(18) { first, second in
      switch second / 6 - first / 6 {
      case 0: 0
      case 1: -50
      default: agreementOfReturn
      }
    }
    #expect(
      try detection.groups(links, photoCount: 18).groups == [
        Array(0...5), Array(6...11), Array(12...17),
      ])
  }

  @Test(arguments: 1...4) func shortIntervalIsNoPlacement(boundary: Int) throws {
    let links = links(12) { ($0 < boundary) == ($1 < boundary) ? 20 : -50 }
    #expect(try detection.groups(links, photoCount: 12).groups == [Array(boundary...11)])
  }

  /// A photo with a wrong pose contradicts some of its own placement and some of the other.
  @Test(arguments: [2, 11]) func photoWithAWrongPoseDividesNothing(wrong: Int) throws {
    let links = links(28) { first, second in
      if first == wrong || second == wrong { return (first + second) % 3 == 0 ? -400 : 0 }
      return (first < 14) == (second < 14) ? 0 : second == first + 14 ? -300 : 0
    }
    #expect(try detection.groups(links, photoCount: 28).groups == [Array(0...13), Array(14...27)])
  }

  @Test func shortIntervalIsExtendedIfLittleContradicts() throws {
    let links = links(16) { ($0 < 4) == ($1 < 4) ? 0 : -50 }
    #expect(try detection.groups(links, photoCount: 16).groups == [Array(5...15), Array(0...4)])
  }

  /// What is known is only that the object was moved after photo 9 and before photo 17.
  @Test func boundaryThatNothingDeterminesIsInTheMiddle() throws {
    let links = links(28) { (3...9).contains($0) && $1 == $0 + 14 ? -50 : 0 }
    #expect(try detection.groups(links, photoCount: 28).groups == [Array(0...13), Array(14...27)])
  }

  // MARK: Contraction

  @Test func photosThatMatchAreOneGroup() throws {
    var links = links(12) { _, _ in 0 }
    for photo in 0..<11 { links[PhotoPair(ID(photo), ID(photo + 1))]?.matches = 30 }
    #expect(try detection.groups(links, photoCount: 12).groups == [Array(0...11)])
  }

  /// Photos of something else match each other, but nothing contradicts them.
  @Test func photosThatMatchOnlyEachOtherAreNoPlacement() throws {
    var links = links(20) { _, _ in 0 }.filter {
      ($0.key.first.index < 12) == ($0.key.second.index < 12)
    }
    for pair in links.keys { links[pair]?.matches = 30 }
    let found = try detection.groups(links, photoCount: 20)
    #expect(found == Placements(groups: [Array(0...19)], basis: .none))
  }

  /// Neither are they if the object was moved between the other photos.
  @Test func photosOfSomethingElseAreNotAThirdPlacement() throws {
    var links = links(18) { first, second in
      second >= 12 ? 0 : first % 2 == second % 2 ? 50 : -50
    }.filter { ($0.key.first.index < 12) == ($0.key.second.index < 12) }
    for pair in links.keys where pair.first.index >= 12 { links[pair]?.matches = 30 }
    let found = try detection.groups(links, photoCount: 18)
    #expect(
      found
        == Placements(
          groups: [[0, 2, 4, 6, 8, 10], [1, 3, 5, 7, 9, 11]], basis: .links))
  }

  @Test func theBasisOfTheDivisionIsKnown() throws {
    let intervals = links(12) { ($0 < 5) == ($1 < 5) ? 0 : -50 }
    let found = try detection.groups(intervals, photoCount: 12)
    #expect(found.basis == .order && found.explanation?.contains("order of their names") == true)
    let unmoved = try detection.groups(links(12) { _, _ in 20 }, photoCount: 12)
    #expect(unmoved.basis == .none && unmoved.explanation == nil)
  }

  @Test func photosThatAgreeOnOnePlacementAreOneGroup() throws {
    let links = links(12) { $1 == $0 + 1 ? 20 : 0 }
    #expect(try detection.groups(links, photoCount: 12).groups == [Array(0...11)])
  }

  @Test func placementsThatInterleaveAreFound() throws {
    let links = links(12) { $0 % 2 == $1 % 2 ? 50 : -50 }
    #expect(
      try detection.groups(links, photoCount: 12).groups == [
        [0, 2, 4, 6, 8, 10], [1, 3, 5, 7, 9, 11],
      ])
  }

  /// A photo that the map links to no other belongs to the photos that it matches.
  @Test func photoWithoutAgreementFollowsItsMatches() throws {
    var links = links(12) { $0 == 0 ? 0 : $0 % 2 == $1 % 2 ? 50 : -50 }
    for photo in [3, 5, 7] { links[PhotoPair(ID(0), ID(photo))]?.matches = 30 }
    #expect(
      try detection.groups(links, photoCount: 12).groups == [
        [0, 1, 3, 5, 7, 9, 11], [2, 4, 6, 8, 10],
      ])
  }

  @Test func contractionDoesNotDependOnTheOrderOfItsLinks() throws {
    var generator = SeededGenerator(seed: 7)
    let links = links(40) { _, _ in Int(generator.uniform() * 40) - 20 }
    var contraction = LinkContraction(links, photoCount: 40)
    try contraction.run(KernelControl()) { $0.agreement }
    for _ in 0..<5 {
      // Each dictionary hashes in an order of its own.
      var copy: [PhotoPair: PlacementDetection.Link] = [:]
      for (pair, link) in links.shuffled() { copy[pair] = link }
      var other = LinkContraction(copy, photoCount: 40)
      try other.run(KernelControl()) { $0.agreement }
      #expect(other.groups == contraction.groups)
    }
  }

  /// 10,000 photos, each linked to the 20 after it: two placements, the second half or every other
  /// photo. `scripts/test --filter largeSets` prints the time.
  @Test(.endToEnd, arguments: [true, false]) func largeSetsAreDivided(areIntervals: Bool) throws {
    let count = 10_000
    func group(_ photo: Int) -> Int { areIntervals ? 2 * photo / count : photo % 2 }
    var links: [PhotoPair: PlacementDetection.Link] = [:]
    for first in 0..<count {
      for second in first + 1..<min(count, first + 21) {
        links[PhotoPair(ID(first), ID(second))] = PlacementDetection.Link(
          agreement: group(first) == group(second) ? 10 : -30)
      }
    }
    let found = try detection.groups(links, photoCount: count)
    #expect(found.basis == (areIntervals ? .order : .links))
    #expect(found.groups.map { Set($0.map(group)) }.allSatisfy { $0.count == 1 })
    #expect(found.groups.map(\.count) == [count / 2, count / 2])
  }

  @Test func detectionStopsWhenCanceled() {
    let flag = CancellationFlag()
    flag.cancel()
    let links = links(40) { ($0 + $1) % 3 - 1 }
    #expect(throws: CancellationError.self) {
      try detection.groups(links, photoCount: 40, KernelControl(flag: flag))
    }
  }

  // MARK: Pairs with two motions

  /// The object moves between all photos, of which the near ones, or all, are matched.
  @Test(arguments: [1, 3, 11]) func turntableHasNoPlacements(reach: Int) throws {
    let graph = graph(12) { $1 - $0 <= reach ? [60, 40] : [] }
    #expect(try detection.groups(graph) == nil)
  }

  @Test func motionsAcrossABoundaryDivideThePhotos() throws {
    let graph = graph(12) { (3...5).contains($0) && (6...8).contains($1) ? [60, 40] : [] }
    #expect(try detection.groups(graph)?.groups == [Array(0...5), Array(6...11)])
  }

  /// The weaker of the two motions counts.
  @Test func weakMotionsDivideNothing() throws {
    let graph = graph(12) { (3...5).contains($0) && (6...8).contains($1) ? [60, 2] : [] }
    #expect(try detection.groups(graph) == nil)
  }

  @Test func rigidSceneHasNoPlacements() throws {
    #expect(try detection.groups(ViewGraph(photoCount: 12, pairs: [])) == nil)
  }

  // MARK: Helpers

  /// Links between all photos; `agreement` has the two photos in ascending order.
  private func links(
    _ photoCount: Int, agreement: (Int, Int) -> Int
  ) -> [PhotoPair: PlacementDetection.Link] {
    var links: [PhotoPair: PlacementDetection.Link] = [:]
    for first in 0..<photoCount {
      for second in (first + 1)..<photoCount {
        links[PhotoPair(ID(first), ID(second))] = PlacementDetection.Link(
          agreement: agreement(first, second))
      }
    }
    return links
  }

  /// A graph of pairs with two motions; `counts` has the number of matches of each motion of two
  /// photos, or is empty.
  private func graph(_ photoCount: Int, counts: (Int, Int) -> [Int]) -> ViewGraph {
    var graph = ViewGraph(photoCount: photoCount, pairs: [])
    for first in 0..<photoCount {
      for second in (first + 1)..<photoCount {
        let pair = PhotoPair(ID(first), ID(second))
        let bodies = counts(first, second).map { count in
          VerifiedPair(
            pair: pair, model: .essential, secondFromFirst: .identity,
            matches: (0..<count).map { FeatureMatch(first: Int32($0), second: Int32($0)) },
            medianAngle: 0)
        }
        guard !bodies.isEmpty else { continue }
        graph.motions.append(TwoMotions(pair: pair, bodies: bodies, isFirstStatic: false))
      }
    }
    return graph
  }
}
