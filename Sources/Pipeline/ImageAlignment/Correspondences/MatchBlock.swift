import SceneModel

/// The matches of consecutive pairs and what their verification found, which one process makes for
/// others.
struct MatchBlock: Equatable, Sendable {
  /// Pairs per block: their photos are few, since pairs are sorted, and their features fit into the
  /// memory. Chosen: matching them takes some seconds.
  static let pairCount = 250

  /// By pair.
  var matches: [[FeatureMatch]] = []
  var verdicts: [PairVerification.Verdict] = []
  /// The verified pairs for which guided matching found more matches.
  var guided: [VerifiedPair] = []

  /// The blocks of some pairs, as ranges of indices.
  static func ranges(of pairs: [PhotoPair]) -> [Range<Int>] {
    stride(from: 0, to: pairs.count, by: pairCount).map {
      $0..<min($0 + pairCount, pairs.count)
    }
  }

  mutating func append(_ other: MatchBlock) {
    matches += other.matches
    verdicts += other.verdicts
    guided += other.guided
  }
}
