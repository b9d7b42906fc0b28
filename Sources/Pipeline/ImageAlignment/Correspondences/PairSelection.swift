import Foundation
import Kernels
import SceneModel

/// Selects the pairs of photos to match.
///
/// Few photos: all pairs, of which preemptive matching rejects the unpromising ones; a sample of
/// the rejected pairs is matched to validate this. Many photos: for each photo the most similar
/// ones by image retrieval and the nearest ones by GPS. Photos in order of capture: the nearest
/// neighbors, and the photos that preemptive matching finds to share the most features; in long
/// sequences, a window of neighbors, and the most similar photos for loop closures. Pairs that
/// don't follow from the order must pass preemptive matching.
package struct PairSelection {
  package struct Options: Hashable, Codable, Sendable {
    /// Up to this number of pairs, all pairs are candidates. Chosen: fifty photos have 1225.
    package var exhaustivePairs = 1300
    /// From this number of pairs on, preemptive matching of all pairs pays off. Chosen.
    package var minimumPreemptivePairs = 100
    /// One in this number of pairs that preemptive matching rejects is matched anyway: rejection
    /// fails for pairs whose large-scale features differ, such as close-ups and fine texture.
    /// Chosen.
    package var rejectionSamplingInterval = 4
    /// Number of partners of a photo in large sets: the most similar ones. Chosen.
    package var partners = 40
    /// Number of partners of a photo by GPS position. Chosen.
    package var positionPartners = 10
    /// Distances in the order of capture at which photos are paired. Chosen: a known order saves 67
    /// and 45 % of the matching time of boot and lund, and costs boot 0.024 of AUC at 0.1°
    /// (docs/experiments/2026-11-alignment.md, Order of capture).
    package var sequenceSteps = [1, 2, 3, 4]
    /// Number of partners of a photo of a sequence: the most similar ones outside its window of
    /// neighbors. Chosen.
    package var sequencePartners = 4
    /// Up to this number of pairs of a sequence, preemptive matching tests all of them, which is
    /// more informative than retrieval. Beyond about sixty photos it would cost more than it saves.
    /// Chosen: 64 photos have 2016.
    package var maximumPreemptiveSequencePairs = 2000
    /// Distances in the order of capture at which photos of such a sequence are paired
    /// unconditionally; more distant neighbors compete with the others by their number of
    /// preemptive matches. Chosen.
    package var preemptiveSequenceSteps = [1, 2]
    /// Pairs of such a sequence with fewer preemptive matches are considered unrelated. Chosen: one
    /// in a hundred of them is verifiable, and barely.
    package var sequenceMatches = 8
    /// Photos are assumed to be in order of capture if this fraction of them is most similar to a
    /// neighbor. Chosen.
    package var orderedShare = 0.7
    /// Number of partners of a photo in a large set that turned out to be in order. Chosen.
    package var orderedPartners = 20
    package var retrieval = PhotoRetrieval.Options()
    package var preemptiveMatching = PreemptiveMatching.Options()

    package init() {}
  }

  /// The selected pairs, sorted, and the candidates that they were selected from.
  package struct Choice: Codable, Sendable, UnitValue {
    package var pairs: [PhotoPair]
    /// Considered pairs, sorted; those that aren't in `pairs` are unpromising.
    package var candidates: [PhotoPair]
    /// The photos most similar to each photo; empty if retrieval wasn't needed.
    package var mostSimilar: [[Int]]
    /// Whether the photos are in the order of capture.
    package var ordering: SampleOrdering
    /// The unpromising pairs that are part of `pairs` to validate preemptive matching.
    package var sample: [PhotoPair]

    package init(
      pairs: [PhotoPair], candidates: [PhotoPair], mostSimilar: [[Int]], ordering: SampleOrdering,
      sample: [PhotoPair] = []
    ) {
      (self.pairs, self.candidates, self.sample) = (pairs, candidates, sample)
      (self.mostSimilar, self.ordering) = (mostSimilar, ordering)
    }
  }

  /// The pairs that are considered, all sorted. No pair is in two of the lists.
  struct Candidates: Codable, Sendable, UnitValue {
    /// Matched without a test.
    var guaranteed: [PhotoPair]
    /// Matched if preemptive matching finds them promising.
    var tested: [PhotoPair]
    /// Not matched.
    var untested: [PhotoPair] = []
    /// As in `Choice`.
    var mostSimilar: [[Int]] = []
    var ordering: SampleOrdering
    /// Whether a sample of the pairs that fail the test is matched to validate it.
    var isSampled = false
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the pairs to match. `positions` has the photos' GPS positions, or is empty.
  package func run(
    _ features: [FeatureSet], positions: [GeographicPosition?] = [], ordering: SampleOrdering,
    _ context: StageContext
  ) throws -> Choice {
    let candidates = try candidates(
      features, positions: positions, ordering: ordering, context.part(from: 0, to: 0.5))
    let promising = try test(
      candidates.tested, features: features, context.part(from: 0.5, to: 1))
    return choice(of: candidates, promising: promising)
  }

  /// The pairs that are tested that pass.
  func test(
    _ pairs: [PhotoPair], features: [FeatureSet], _ context: StageContext
  ) throws -> [PhotoPair] {
    try PreemptiveMatching(options.preemptiveMatching).run(pairs, features: features, context)
  }

  /// Returns the pairs that are considered.
  func candidates(
    _ features: [FeatureSet], positions: [GeographicPosition?], ordering: SampleOrdering,
    _ context: StageContext
  ) throws -> Candidates {
    let isSequential = ordering == .sequential
    let photos = features.indices.filter { features[$0].count > 0 }
    let pairCount = photos.count * (photos.count - 1) / 2
    if !isSequential, pairCount <= options.exhaustivePairs {
      let all = photos.indices.flatMap { i in photos[(i + 1)...].map { pair(photos[i], $0) } }
      let isTested = all.count >= options.minimumPreemptivePairs
      return Candidates(
        guaranteed: isTested ? [] : all, tested: isTested ? all : [], ordering: .unordered,
        isSampled: true)
    }
    if isSequential, pairCount <= options.maximumPreemptiveSequencePairs {
      return try sequence(photos, features, context)
    }
    let mostSimilar = try PhotoRetrieval(options.retrieval)
      .run(features, partners: 2 * options.partners, context)
    let isOrdered = isSequential || isInOrder(mostSimilar)
    let guaranteed = isOrdered ? neighbors(photos, options.sequenceSteps) : []
    let count =
      isSequential
      ? options.sequencePartners : isOrdered ? options.orderedPartners : options.partners
    var likely = retrieved(mostSimilar, count, excluding: guaranteed)
    if !isSequential { likely.formUnion(nearest(positions, features).subtracting(guaranteed)) }
    return Candidates(
      guaranteed: guaranteed.sorted(), tested: likely.sorted(), mostSimilar: mostSimilar,
      ordering: ordering)
  }

  /// The pairs to match: those that pass the test, and with them perhaps a sample of the others.
  func choice(of candidates: Candidates, promising: [PhotoPair]) -> Choice {
    let rejected =
      candidates.isSampled ? Set(candidates.tested).subtracting(promising).sorted() : []
    let sample = stride(from: 0, to: rejected.count, by: max(1, options.rejectionSamplingInterval))
      .map { rejected[$0] }
    return Choice(
      pairs: (candidates.guaranteed + promising + sample).sorted(),
      candidates: Set(candidates.guaranteed + candidates.tested + candidates.untested).sorted(),
      mostSimilar: candidates.mostSimilar, ordering: candidates.ordering, sample: sample)
  }

  func pair(_ first: Int, _ second: Int) -> PhotoPair { PhotoPair(ID(first), ID(second)) }

  /// Pairs of each photo with the `count` most similar photos that it isn't paired with already.
  func retrieved(
    _ mostSimilar: [[Int]], _ count: Int, excluding known: Set<PhotoPair>
  ) -> Set<PhotoPair> {
    Set(
      mostSimilar.enumerated().flatMap { photo, others in
        others.lazy.map { pair(photo, $0) }.filter { !known.contains($0) }.prefix(count)
      })
  }

  /// Whether most photos are most similar to one of the two preceding or following photos.
  private func isInOrder(_ mostSimilar: [[Int]]) -> Bool {
    let near = mostSimilar.enumerated().count { photo, others in
      others.first.map { abs($0 - photo) <= 2 } ?? false
    }
    return Double(near) >= options.orderedShare * Double(mostSimilar.count)
  }

  /// A window of neighbors among `photos`, and the two ends, where the path may close. Skipped
  /// photos in between, which have no features, don't interrupt the path.
  func neighbors(_ photos: [Int], _ steps: [Int]) -> Set<PhotoPair> {
    let count = photos.count
    var chosen: Set<PhotoPair> = []
    for first in 0..<count {
      for step in steps where first + step < count {
        chosen.insert(pair(photos[first], photos[first + step]))
      }
    }
    for first in 0..<min(2, count) {
      for second in max(first + 1, count - 2)..<max(first + 1, count) {
        chosen.insert(pair(photos[first], photos[second]))
      }
    }
    return chosen
  }

  /// Pairs of each photo that has a position with the nearest others.
  private func nearest(
    _ positions: [GeographicPosition?], _ features: [FeatureSet]
  ) -> Set<PhotoPair> {
    // Limit: the mean length of a degree of latitude; on the scale of one set the Earth is flat.
    let metersPerDegree = 111_320.0
    let points = positions.enumerated().compactMap { photo, position in
      position.map { position in
        let narrowing = cos(position.latitudeDegrees * .pi / 180)
        return (
          photo: photo,
          point: metersPerDegree
            * SIMD2(position.longitudeDegrees * narrowing, position.latitudeDegrees)
        )
      }
    }
    .filter { features[$0.photo].count > 0 }
    return Set(
      points.flatMap { origin in
        points.filter { $0.photo != origin.photo }
          .map { (photo: $0.photo, distance: ($0.point - origin.point).squaredLength) }
          .sorted { ($0.distance, $0.photo) < ($1.distance, $1.photo) }
          .prefix(options.positionPartners).map { pair(origin.photo, $0.photo) }
      })
  }
}
