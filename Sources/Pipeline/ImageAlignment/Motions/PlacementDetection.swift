import SceneModel

/// Divides photos into groups between which the object was moved, for instance laid on another
/// side.
///
/// Photos taken before and after the move have nearly the same pose in a map of the surroundings,
/// or in one of the object, but show different things. The evidence of such pairs, for and against
/// the same placement, is a signed graph, which greedy edge contraction divides (Keuper et al.,
/// "Efficient decomposition of image and mesh graphs by lifted multicuts", ICCV 2015).
struct PlacementDetection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of photos of a placement.
    var minimumPhotos = 5

    init() {}
  }

  var options = Options()

  /// The groups, each in ascending order, larger ones first; one group if the object did not move.
  /// Photos without a pose form groups of their own if they match each other.
  func run(
    _ evidence: [SceneAmbiguityCheck.Evidence], isConflict: (SceneAmbiguityCheck.Evidence) -> Bool,
    _ reconstruction: Reconstruction, _ graph: ViewGraph
  ) -> [[Int]] {
    var links: [PhotoPair: Link] = [:]
    for one in evidence {
      links[one.pair, default: Link()].evidence +=
        isConflict(one) ? -one.absent : max(0, one.present - one.absent)
    }
    for pair in graph.pairs where reconstruction.isPosedAlike(pair.pair) {
      links[pair.pair, default: Link()].matches += pair.matches.count
    }
    var sets = DisjointSets(count: graph.photoCount)
    contract(&links, &sets) { $0.evidence }
    // Photos that are nowhere near each other in the map are linked by matches alone.
    contract(&links, &sets) { $0.evidence < 0 ? 0 : $0.matches }
    return sets.groups().filter { $0.count >= options.minimumPhotos }
      .sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// What links two photos or groups of photos.
  private struct Link {
    /// Points that the map predicts and the photos show, minus those that they should show but
    /// don't.
    var evidence = 0
    var matches = 0
  }

  /// Contracts the link of the highest weight until none is positive; parallel links add up.
  private func contract(
    _ links: inout [PhotoPair: Link], _ sets: inout DisjointSets, weight: (Link) -> Int
  ) {
    while let best = links.filter({ weight($0.value) > 0 }).max(by: {
      (weight($0.value), $1.key) < (weight($1.value), $0.key)
    }) {
      let (kept, gone) = (best.key.first, best.key.second)
      sets.join(kept.index, gone.index)
      links[best.key] = nil
      for (pair, link) in links where pair.first == gone || pair.second == gone {
        links[pair] = nil
        let other = pair.first == gone ? pair.second : pair.first
        links[PhotoPair(kept, other), default: Link()].evidence += link.evidence
        links[PhotoPair(kept, other), default: Link()].matches += link.matches
      }
    }
  }
}

extension Reconstruction {
  /// Whether both photos have a pose, or neither has.
  fileprivate func isPosedAlike(_ pair: PhotoPair) -> Bool {
    (poses[pair.first.index] == nil) == (poses[pair.second.index] == nil)
  }
}
