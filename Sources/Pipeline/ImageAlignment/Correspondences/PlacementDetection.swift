import SceneModel

/// Divides photos into groups between which the object was moved, for instance laid on another
/// side.
///
/// The evidence is for and against two photos showing the object in the same placement. Photos are
/// usually in the order of capture, and then placements are intervals, which dynamic programming
/// finds. Otherwise greedy edge contraction divides the signed graph (Keuper et al., "Efficient
/// decomposition of image and mesh graphs by lifted multicuts", ICCV 2015).
struct PlacementDetection: Sendable {
  struct Options: Hashable, Codable, Sendable {
    var intervals = CaptureIntervals.Options()
    /// Weight of a point that is missing in a photo, relative to one that is there: of the points
    /// that the map predicts, up to a sixth are not found even if nothing moved.
    var absenceWeight = 4

    init() {}
  }

  /// What links two photos or groups of photos.
  struct Link: Sendable {
    /// Positive if they show the object in the same placement, negative if they don't.
    var evidence = 0
    /// Number of matches.
    var matches = 0
  }

  var options = Options()

  /// The groups by the pairs of a graph that show two motions; nil if the object was not moved a
  /// few times only, but between most photos.
  func groups(_ graph: ViewGraph) -> [[Int]]? {
    let result = intervals(links(of: graph.motions), photoCount: graph.photoCount)
    return result.count > 1 ? result : nil
  }

  /// Two motions are evidence against the same placement.
  func links(of motions: [TwoMotions]) -> [PhotoPair: Link] {
    var links: [PhotoPair: Link] = [:]
    for motion in motions {
      links[motion.pair] = Link(evidence: -(motion.bodies.map(\.matches.count).min() ?? 0))
    }
    return links
  }

  /// The groups, each in ascending order, larger ones first; one group if the object did not move.
  func groups(_ links: [PhotoPair: Link], photoCount: Int) -> [[Int]] {
    let found = intervals(links, photoCount: photoCount)
    let groups = found.isEmpty ? contracted(links, photoCount: photoCount) : found
    return groups.sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// The division of the order of capture; empty if it does not explain the evidence.
  private func intervals(_ links: [PhotoPair: Link], photoCount: Int) -> [[Int]] {
    CaptureIntervals(
      links.mapValues(\.evidence), photoCount: photoCount, options: options.intervals
    ).division() ?? []
  }

  // MARK: Contraction

  /// The groups of photos that remain after contracting links: first by evidence, then, between
  /// photos that are nowhere near each other in the map, by matches.
  private func contracted(_ links: [PhotoPair: Link], photoCount: Int) -> [[Int]] {
    var links = links
    var sets = DisjointSets(count: photoCount)
    if links.values.contains(where: { $0.evidence < 0 }) {
      contract(&links, &sets) { $0.evidence }
      contract(&links, &sets) { $0.evidence < 0 ? 0 : $0.matches }
    } else {
      for pair in links.keys { sets.join(pair.first.index, pair.second.index) }
    }
    return sets.groups().filter { $0.count >= options.intervals.minimumPhotos }
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
