import TestSupport
import Testing

@testable import Pipeline

/// Two bodies of 60 tracks each: a track of the second one is 60 more than that of the first one.
@Suite struct BodyAssignmentTests {
  private static let count = 60

  /// The tracks of both motions of a pair that shows a range of each body's tracks.
  private static func motions(_ tracks: Range<Int>, isSwapped: Bool = false) -> [[Int32]] {
    let motions = [first(tracks), second(tracks)]
    return isSwapped ? motions.reversed() : motions
  }

  private static func first(_ tracks: Range<Int>) -> [Int32] { tracks.map(Int32.init) }

  private static func second(_ tracks: Range<Int>) -> [Int32] { tracks.map { Int32(count + $0) } }

  private static func assignment(
    _ motions: [[[Int32]]], staticPairs: Set<Int> = [], sweeps: Int = 3
  ) -> BodyAssignment {
    var assignment = BodyAssignment(
      motions, isStatic: motions.indices.map(staticPairs.contains), trackCount: 2 * count)
    assignment.run(minimumVotes: 8, sweeps: sweeps)
    return assignment
  }

  /// The bodies of the tracks of both bodies; nil if tracks of one body differ.
  private static func bodies(
    _ assignment: BodyAssignment, of tracks: Range<Int> = 0..<count
  ) -> [Body?]? {
    let bodies = [0, count].map { offset in
      Set(tracks.map { assignment.body(ofTrack: offset + $0, minimumShare: 0.75) })
    }
    return bodies.allSatisfy { $0.count == 1 } ? bodies.flatMap { $0 } : nil
  }

  /// Pairs that each share 15 tracks of each body with the next; most have no track in common.
  private static func chain(isSwapped: (Int) -> Bool) -> [[[Int32]]] {
    (0..<9).map { motions(5 * $0..<5 * $0 + 20, isSwapped: isSwapped($0)) }
  }

  @Test(arguments: 1...8 as ClosedRange<UInt64>)
  func bodiesAreRecoveredUpToASwap(seed: UInt64) throws {
    var random = SeededGenerator(seed: seed)
    let isSwapped = (0..<9).map { _ in random.below(2) == 1 }
    let assignment = Self.assignment(Self.chain { isSwapped[$0] }.shuffled(using: &random))
    let bodies = try #require(Self.bodies(assignment))
    #expect(bodies == [.first, .second] || bodies == [.second, .first])
    #expect(assignment.assignedTrackCount == 2 * Self.count)
  }

  /// The strongest pair, from which the assignment would start, has its motions in the other order.
  @Test(arguments: 1...8) func aStaticMotionFixesTheSign(pair: Int) {
    let motions = Self.chain { $0 != pair }
    #expect(Self.bodies(Self.assignment(motions)) == [.second, .first])
    #expect(Self.bodies(Self.assignment(motions, staticPairs: [pair])) == [.first, .second])
  }

  /// Every track that two pairs share gives one vote.
  @Test(arguments: [(3, false), (4, true)])
  func pairsWithTooFewVotesStayOpen(shared: Int, isAssigned: Bool) {
    let assignment = Self.assignment([
      Self.motions(0..<20), Self.motions(0..<20),
      Self.motions(20 - shared..<39 - shared, isSwapped: true),
    ])
    #expect(Self.bodies(assignment, of: 0..<20) == [.first, .second])
    #expect(
      Self.bodies(assignment, of: 20..<39 - shared)
        == (isAssigned ? [.first, .second] : [nil, nil]))
    #expect(assignment.assignedTrackCount == 2 * (isAssigned ? 39 - shared : 20))
  }

  /// In the strongest pair, the tracks 20 to 33 are part of the wrong motions. The last pair has
  /// most of its tracks in common with it, and is assigned before the pairs that contradict.
  @Test func sweepsCorrectAWrongStart() {
    let mixed = [
      Self.first(0..<16) + Self.second(20..<34), Self.second(0..<16) + Self.first(20..<34),
    ]
    let right = (0..<5).map { _ in
      [Self.first(0..<16) + Self.first(20..<30), Self.second(0..<16) + Self.second(20..<30)]
    }
    let motions = [mixed, Self.motions(0..<16)] + right + [Self.motions(20..<37)]
    let (before, after) = (
      Self.assignment(motions, sweeps: 0), Self.assignment(motions, sweeps: 1)
    )
    for assignment in [before, after] {
      #expect(Self.bodies(assignment, of: 0..<16) == [.first, .second])
    }
    #expect(Self.bodies(before, of: 34..<37) == [.second, .first])
    #expect(Self.bodies(after, of: 34..<37) == [.first, .second])
    #expect(Self.bodies(after, of: 20..<30) == [.first, .second])
    // One pair is for either body.
    #expect(Self.bodies(after, of: 30..<34) == [nil, nil])
  }

  /// One of four pairs has the first track in its other motion.
  @Test(arguments: [(0.75, .first), (0.76, nil)] as [(Double, Body?)])
  func tracksBelowTheMinimumShareHaveNoBody(minimumShare: Double, body: Body?) {
    var motions = (0..<4).map { _ in Self.motions(0..<20) }
    motions[2] = [Self.first(1..<20), Self.second(0..<20) + Self.first(0..<1)]
    let assignment = Self.assignment(motions)
    #expect(assignment.body(ofTrack: 0, minimumShare: minimumShare) == body)
    #expect(assignment.body(ofTrack: 1, minimumShare: 1) == .first)
    // No pair shows this one.
    #expect(assignment.body(ofTrack: 30, minimumShare: 0) == nil)
  }

  /// No other pair confirms a single one.
  @Test(arguments: [0, 1]) func withoutSeveralPairsNothingIsAssigned(count: Int) {
    let assignment = Self.assignment((0..<count).map { _ in Self.motions(0..<20) })
    #expect(assignment.assignedTrackCount == 0)
    #expect(Self.bodies(assignment) == [nil, nil])
  }
}
