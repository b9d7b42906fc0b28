import Foundation
import Kernels
import SceneModel

/// Chooses the pairs of photos worth matching.
///
/// Few photos: all pairs, of which a first look rejects the hopeless, with a sample to prove it right.
/// Many photos: for each the photos most alike as a whole and the nearest by GPS. Photos in order of
/// capture: the nearest neighbours, and the photos that a first look finds to share the most; among
/// many, a window of neighbours, and the photos most alike where the path comes back to itself.
/// Pairs that the order does not vouch for must pass the first look.
package struct PairSelection {
  package struct Options: Hashable, Codable, Sendable {
    /// Up to this number of pairs all are considered.
    package var exhaustivePairs = 1300
    /// From this number of pairs on, a first look at all of them pays.
    package var lookedPairs = 100
    /// One of so many pairs that the first look rejects is matched all the same: the look is wrong
    /// about pairs whose large features differ, as those of close-ups and of fine texture do.
    package var sampledRejection = 4
    /// Partners of a photo among many: those most alike.
    package var partners = 40
    /// Partners of a photo by its position.
    package var positionPartners = 10
    /// Distances in the order of capture at which photos are paired.
    package var sequenceSteps = [1, 2, 3, 4]
    /// Partners of a photo of a sequence: those most alike outside its window of neighbours.
    package var sequencePartners = 4
    /// Up to this number of pairs of a sequence all are looked at, which tells more than retrieval.
    /// Beyond some sixty photos it would cost more than it spares.
    package var sequenceLookedPairs = 2000
    /// Distances in the order of capture at which photos of such a sequence are paired; further
    /// neighbours compete with the rest by what the look has seen of them.
    package var lookedSequenceSteps = [1, 2]
    /// Pairs of such a sequence that the look finds fewer matches for are taken for strangers: of
    /// pairs with fewer, one in a hundred is verified, and barely.
    package var sequenceMatches = 8
    /// Photos are taken to be in order of capture when this share of them is most like a neighbour.
    package var orderedShare = 0.7
    /// Partners of a photo among many that turned out to be in order.
    package var orderedPartners = 20
    package var retrieval = PhotoRetrieval.Options()
    package var firstLook = FirstLook.Options()

    package init() {}
  }

  /// The pairs chosen, sorted, and what they were chosen from.
  package struct Choice: Sendable {
    package var pairs: [PhotoPair]
    /// Pairs that were considered, sorted; those that aren't in `pairs` looked hopeless.
    package var candidates: [PhotoPair]
    /// The photos most alike each photo; empty where retrieval wasn't needed.
    package var alike: [[Int]]
    package var isSequential: Bool
    /// Those of `pairs` that looked hopeless and show whether the first look was right.
    package var sample: [PhotoPair]

    package init(
      pairs: [PhotoPair], candidates: [PhotoPair], alike: [[Int]], isSequential: Bool,
      sample: [PhotoPair] = []
    ) {
      (self.pairs, self.candidates, self.sample) = (pairs, candidates, sample)
      (self.alike, self.isSequential) = (alike, isSequential)
    }
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The pairs to match. `positions` has the photos' GPS positions, or is empty.
  package func run(
    _ features: [FeatureSet], positions: [GeographicPosition?] = [], isSequential: Bool,
    _ context: StageContext
  ) throws -> Choice {
    let photos = features.indices.filter { features[$0].count > 0 }
    if !isSequential, photos.count * (photos.count - 1) / 2 <= options.exhaustivePairs {
      let all = photos.indices.flatMap { i in photos[(i + 1)...].map { pair(photos[i], $0) } }
      return try exhaustive(all, features, context)
    }
    if isSequential, photos.count * (photos.count - 1) / 2 <= options.sequenceLookedPairs {
      return try sequence(photos, features, context)
    }
    let alike = try PhotoRetrieval(options.retrieval)
      .run(features, partners: 2 * options.partners, context.part(from: 0, to: 0.5))
    let isOrdered = isSequential || isInOrder(alike)
    let sure = isOrdered ? neighbours(photos, options.sequenceSteps) : []
    let count =
      isSequential
      ? options.sequencePartners : isOrdered ? options.orderedPartners : options.partners
    var likely = retrieved(alike, count, besides: sure)
    if !isSequential { likely.formUnion(nearest(positions, features).subtracting(sure)) }
    let hopeful = try FirstLook(options.firstLook)
      .run(likely.sorted(), features: features, context.part(from: 0.5, to: 1))
    return Choice(
      pairs: sure.union(hopeful).sorted(), candidates: sure.union(likely).sorted(), alike: alike,
      isSequential: isSequential)
  }

  /// All pairs but those that the first look rejects and that aren't in the sample of these.
  private func exhaustive(
    _ all: [PhotoPair], _ features: [FeatureSet], _ context: StageContext
  ) throws -> Choice {
    guard all.count >= options.lookedPairs else {
      return Choice(pairs: all, candidates: all, alike: [], isSequential: false)
    }
    let hopeful = try FirstLook(options.firstLook).run(all, features: features, context)
    let rejected = Set(all).subtracting(hopeful).sorted()
    let sample = stride(from: 0, to: rejected.count, by: max(1, options.sampledRejection))
      .map { rejected[$0] }
    return Choice(
      pairs: (hopeful + sample).sorted(), candidates: all, alike: [], isSequential: false,
      sample: sample)
  }

  func pair(_ first: Int, _ second: Int) -> PhotoPair { PhotoPair(ID(first), ID(second)) }

  /// Pairs of each photo with the `count` photos most alike that it isn't paired with already.
  func retrieved(
    _ alike: [[Int]], _ count: Int, besides known: Set<PhotoPair>
  ) -> Set<PhotoPair> {
    Set(
      alike.enumerated().flatMap { photo, others in
        others.lazy.map { pair(photo, $0) }.filter { !known.contains($0) }.prefix(count)
      })
  }

  /// Whether most photos are most like one of the next but one in their order.
  private func isInOrder(_ alike: [[Int]]) -> Bool {
    let near = alike.enumerated().count { photo, others in
      others.first.map { abs($0 - photo) <= 2 } ?? false
    }
    return Double(near) >= options.orderedShare * Double(alike.count)
  }

  /// A window of neighbours among `photos`, and the two ends, which may have come together. Photos
  /// left out in between, which have no features, don't break the path.
  func neighbours(_ photos: [Int], _ steps: [Int]) -> Set<PhotoPair> {
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
    let metresPerDegree = 111_320.0
    let places = positions.enumerated().compactMap { photo, position in
      position.map { position in
        let narrowing = cos(position.latitudeDegrees * .pi / 180)
        return (
          photo: photo,
          place: metresPerDegree
            * SIMD2(position.longitudeDegrees * narrowing, position.latitudeDegrees)
        )
      }
    }
    .filter { features[$0.photo].count > 0 }
    return Set(
      places.flatMap { own in
        places.filter { $0.photo != own.photo }
          .map { (photo: $0.photo, distance: ($0.place - own.place).squaredLength) }
          .sorted { ($0.distance, $0.photo) < ($1.distance, $1.photo) }
          .prefix(options.positionPartners).map { pair(own.photo, $0.photo) }
      })
  }
}
