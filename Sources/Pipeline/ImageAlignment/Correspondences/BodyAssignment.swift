/// Assigns the two motions of each pair of photos to two bodies by the feature tracks that motions
/// of different pairs have in common.
struct BodyAssignment {
  /// The tracks of both motions, by pair.
  private let motions: [[[Int32]]]
  /// Whether the first motion of a pair is known to be that of the first body.
  private let isStatic: [Bool]
  /// The body of each pair's second motion; nil while it is open.
  private var bodies: [Body?]
  /// For each track, the number of assigned motions that it is part of, and how many more of them
  /// are of the second body than of the first.
  private var scores: [(lead: Int, count: Int)]

  init(_ motions: [[[Int32]]], isStatic: [Bool], trackCount: Int) {
    (self.motions, self.isStatic) = (motions, isStatic)
    bodies = motions.map { _ in nil }
    scores = Array(repeating: (0, 0), count: trackCount)
  }

  /// Starts from the static pairs, or else from the pair with the strongest two motions, continues
  /// with the pairs of the clearest votes, and assigns all pairs again `sweeps` times. Pairs with
  /// less than `minimumVotes` stay open.
  mutating func run(minimumVotes: Int, sweeps: Int) {
    assignFirst()
    while true {
      let open = motions.indices.filter { bodies[$0] == nil }.map { (pair: $0, vote: vote($0)) }
      let best = open.map { abs($0.vote) }.max() ?? 0
      guard best >= minimumVotes else { break }
      for (pair, vote) in open where 2 * abs(vote) >= best { assign(pair, to: Body(vote: vote)) }
    }
    for _ in 0..<sweeps {
      for pair in motions.indices where bodies[pair] != nil && !isStatic[pair] {
        assign(pair, to: nil)
        let vote = vote(pair)
        assign(pair, to: abs(vote) < minimumVotes ? nil : Body(vote: vote))
      }
    }
  }

  /// The number of tracks of assigned motions.
  var assignedTrackCount: Int { scores.count { $0.count > 0 } }

  /// The body that at least `minimumShare` of a track's motions belong to; nil without one.
  func body(ofTrack track: Int, minimumShare: Double) -> Body? {
    let (lead, count) = scores[track]
    guard count > 0, Double(abs(lead)) >= (2 * minimumShare - 1) * Double(count) else { return nil }
    return Body(vote: lead)
  }

  private mutating func assignFirst() {
    for pair in motions.indices where isStatic[pair] { assign(pair, to: .second) }
    guard !isStatic.contains(true) else { return }
    let strengths = motions.map { min($0[0].count, $0[1].count) }
    if let first = strengths.indices.max(by: { (strengths[$0], $1) < (strengths[$1], $0) }) {
      assign(first, to: .second)
    }
  }

  /// Assigns the second motion of a pair to a body, and the first to the other; nil leaves them
  /// open.
  private mutating func assign(_ pair: Int, to body: Body?) {
    add(pair, -1)
    bodies[pair] = body
    add(pair, 1)
  }

  /// Adds the motions of a pair to the scores, or removes them if `amount` is −1.
  private mutating func add(_ pair: Int, _ amount: Int) {
    guard let second = bodies[pair] else { return }
    for (tracks, body) in zip(motions[pair], [second.other, second]) {
      for track in tracks {
        scores[Int(track)].lead += body == .second ? amount : -amount
        scores[Int(track)].count += amount
      }
    }
  }

  /// How many more tracks favor the second body for the second motion of a pair than the first.
  private func vote(_ pair: Int) -> Int {
    func lead(_ tracks: [Int32]) -> Int {
      tracks.reduce(0) { $0 + scores[Int($1)].lead.signum() }
    }
    return lead(motions[pair][1]) - lead(motions[pair][0])
  }
}
