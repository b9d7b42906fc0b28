import Kernels
import SceneModel

/// Selects additional pairs on the basis of the verified ones (cf. query expansion in image
/// retrieval, Chum et al., ICCV 2007): partners of partners, and retries for photos that have few
/// partners or are disconnected from the largest group.
package struct PairExpansion {
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum number of partners of partners that a photo is paired with. Chosen.
    package var partners = 10
    /// The same for photos in order of capture. Chosen.
    package var sequencePartners = 1
    /// Minimum number of verified partners that two photos must have in common. Chosen: a single
    /// one may be a false pair.
    package var commonPartners = 2
    /// A photo with fewer verified partners is matched with all its candidates, including the
    /// unpromising ones. Chosen.
    package var minimumPartners = 4
    /// Number of most similar photos that such a photo is additionally matched with. Chosen.
    package var retryPartners = 10

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns pairs that are not among those of `choice`, sorted.
  package func run(
    _ choice: PairSelection.Choice, _ graph: ViewGraph, features: [FeatureSet],
    preemptiveMatching: PreemptiveMatching, _ context: StageContext
  ) throws -> [PhotoPair] {
    let partners = graph.partners
    let matched = Set(choice.pairs)
    var chosen = retries(choice, partners).subtracting(matched)
    if !choice.mostSimilar.isEmpty {
      let count = choice.ordering == .sequential ? options.sequencePartners : options.partners
      let common = commonPairs(partners, count, excluding: Set(choice.candidates))
        .subtracting(chosen)
      chosen.formUnion(try preemptiveMatching.run(common.sorted(), features: features, context))
    }
    return chosen.sorted()
  }

  /// All candidates and the most similar photos of photos with few partners or outside the largest
  /// group.
  private func retries(
    _ choice: PairSelection.Choice, _ partners: [[Int]]
  ) -> Set<PhotoPair> {
    let group = groups(partners)
    let sizes = group.reduce(into: [Int](repeating: 0, count: partners.count)) { $0[$1] += 1 }
    let largest = sizes.indices.max { (sizes[$0], $1) < (sizes[$1], $0) }
    func isWeak(_ photo: ID<Photo>) -> Bool {
      partners[photo.index].count < options.minimumPartners || group[photo.index] != largest
    }
    var retryPartners = Set(choice.candidates.filter { isWeak($0.first) || isWeak($0.second) })
    for (photo, others) in choice.mostSimilar.enumerated() where isWeak(ID(photo)) {
      retryPartners.formUnion(
        others.prefix(options.retryPartners).map { PhotoPair(ID(photo), ID($0)) })
    }
    return retryPartners
  }

  /// The lowest photo index in each photo's connected component.
  private func groups(_ partners: [[Int]]) -> [Int] {
    var sets = DisjointSets(count: partners.count)
    for (photo, others) in partners.enumerated() {
      for other in others { sets.join(photo, other) }
    }
    return partners.indices.map { sets.root($0) }
  }

  /// Pairs of each photo with those that share the most verified partners with it.
  private func commonPairs(
    _ partners: [[Int]], _ count: Int, excluding known: Set<PhotoPair>
  ) -> Set<PhotoPair> {
    var chosen: Set<PhotoPair> = []
    for photo in partners.indices {
      var counts: [Int: Int] = [:]
      for partner in partners[photo] {
        for other in partners[partner] where other != photo { counts[other, default: 0] += 1 }
      }
      let best = counts.filter {
        $0.value >= options.commonPartners && !known.contains(PhotoPair(ID(photo), ID($0.key)))
      }
      .sorted { ($0.value, $1.key) > ($1.value, $0.key) }.prefix(count)
      chosen.formUnion(best.map { PhotoPair(ID(photo), ID($0.key)) })
    }
    return chosen
  }
}
