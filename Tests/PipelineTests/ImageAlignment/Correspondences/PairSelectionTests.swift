import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@Suite struct PairSelectionTests {
  static func scene(
    _ layout: GrowthScene.Layout, photos: Int = 60, isShuffled: Bool = true
  ) throws -> GrowthScene {
    var options = GrowthScene.Options()
    (options.layout, options.photoCount, options.isShuffled) = (layout, photos, isShuffled)
    options.featuresPerPhoto = 1000
    return try GrowthScene(options, KernelControl(threadCount: 2))
  }

  static func options(partners: Int) -> PairSelection.Options {
    var options = PairSelection.Options()
    (options.exhaustivePairs, options.partners) = (30, partners)
    return options
  }

  @Test func retrievalFindsThePhotosThatOverlapMost() throws {
    let scene = try Self.scene(.streets)
    let overlaps = scene.overlaps(minimum: 60)
    let mostSimilar = try PhotoRetrieval().run(scene.features, partners: 10, StageContext())
    let found = overlaps.keys.count {
      mostSimilar[$0.first.index].contains($0.second.index)
        || mostSimilar[$0.second.index].contains($0.first.index)
    }
    #expect(overlaps.count > 50)
    #expect(Double(found) > 0.95 * Double(overlaps.count))
    for (photo, others) in mostSimilar.enumerated() {
      #expect(others.count == 10 && Set(others).count == 10 && !others.contains(photo))
    }
  }

  @Test func retrievalIsTheSameWithAnyNumberOfThreads() throws {
    let scene = try Self.scene(.orbits, photos: 20)
    let mostSimilar = try [1, 2].map { threads in
      try PhotoRetrieval().run(
        scene.features, partners: 19, StageContext(control: KernelControl(threadCount: threads)))
    }
    #expect(mostSimilar[0] == mostSimilar[1])
  }

  @Test func photosWithoutFeaturesHaveNoPartners() throws {
    var features = try Self.scene(.orbits, photos: 12).features
    features[3] = FeatureSet()
    let mostSimilar = try PhotoRetrieval().run(features, partners: 11, StageContext())
    #expect(mostSimilar[3].isEmpty && mostSimilar.allSatisfy { !$0.contains(3) })
    #expect(
      try PhotoRetrieval().run([FeatureSet(), FeatureSet()], partners: 1, StageContext())
        == [[], []])
    #expect(try PhotoRetrieval().run([], partners: 5, StageContext()).isEmpty)
  }

  @Test func partnersInLargeSetsAreLimitedAndCorrect() throws {
    let scene = try Self.scene(.streets)
    let choice = try PairSelection(Self.options(partners: 10))
      .run(scene.features, ordering: .unordered, StageContext())
    #expect(choice.pairs == choice.pairs.sorted() && Set(choice.pairs).count == choice.pairs.count)
    #expect(choice.pairs.count <= 60 * 10)
    let chosen = Set(choice.pairs)
    let overlaps = scene.overlaps(minimum: 60)
    let found = overlaps.keys.count { chosen.contains($0) }
    #expect(Double(found) > 0.95 * Double(overlaps.count))
  }

  @Test(.endToEnd) func preemptiveMatchingIsValidatedByASample() throws {
    let scene = try Self.scene(.streets, photos: 30)
    var options = CorrespondenceSearch.Options()
    options.selection.preemptiveMatching.features = 300
    func search(_ options: CorrespondenceSearch.Options) throws -> (pairs: Int, verified: Int) {
      let context = StageContext()
      let graph = try CorrespondenceSearch(options).run(
        photos: scene.photos, cameras: [scene.camera], features: scene.features,
        ordering: .unordered, context
      ).viewGraph
      return (Int(context.notes.counts["pairs"] ?? 0), graph.pairs.count)
    }
    let all = 30 * 29 / 2
    let preemptive = try search(options)
    options.selection.minimumPreemptivePairs = .max
    let exhaustive = try search(options)
    #expect(exhaustive.pairs == all)
    #expect(preemptive.pairs < all)
    #expect(Double(preemptive.verified) > 0.95 * Double(exhaustive.verified))
    // If preemptive matching rejects everything, the sample reveals it, and all pairs are matched.
    options.selection.minimumPreemptivePairs = 0
    options.selection.preemptiveMatching.minimumMatches = .max
    #expect(try search(options) == exhaustive)
  }

  @Test func orderOfCaptureIsRecognized() throws {
    let scene = try Self.scene(.orbits, isShuffled: false)
    var options = Self.options(partners: 8)
    options.orderedPartners = 0
    let pairs = try PairSelection(options)
      .run(scene.features, ordering: .unordered, StageContext()).pairs
    #expect((0..<59).allSatisfy { pairs.contains(PhotoPair(ID($0), ID($0 + 1))) })
    #expect(pairs.allSatisfy { $0.second.index - $0.first.index <= 4 || $0.first.index < 2 })
  }

  @Test func sequenceSkipsMissingPhotosAndClosesLoops() throws {
    let scene = try Self.scene(.orbits, isShuffled: false)
    var features = scene.features
    // Two consecutive photos have no features.
    (features[20], features[21]) = (FeatureSet(), FeatureSet())
    var options = PairSelection.Options()
    options.preemptiveMatching.features = 400
    let choice = try PairSelection(options).run(features, ordering: .sequential, StageContext())
    let pairs = Set(choice.pairs)
    #expect(choice.pairs == choice.pairs.sorted() && pairs.count == choice.pairs.count)
    #expect(pairs.count < 60 * 6)
    #expect(!pairs.contains { [20, 21].contains($0.first.index) || $0.second.index == 21 })
    let overlaps = scene.overlaps(minimum: 100)
    #expect(try #require(overlaps[PhotoPair(ID(19), ID(22))]) >= 100)
    #expect(pairs.contains(PhotoPair(ID(19), ID(22))))
    // For each photo, the one from another time that shares the most points.
    let distant = overlaps.filter { $0.key.second.index - $0.key.first.index > 4 }
    let best = (0..<60).filter { $0 != 20 && $0 != 21 }.compactMap { photo in
      distant.filter {
        ($0.key.first.index == photo || $0.key.second.index == photo)
          && features[$0.key.first.index].count > 0 && features[$0.key.second.index].count > 0
      }.max { ($0.value, $1.key) < ($1.value, $0.key) }?.key
    }
    #expect(best.count > 20)
    #expect(10 * best.count { pairs.contains($0) } > 9 * best.count)
  }

  @Test func nearbyPositionsArePaired() throws {
    let features = try Self.scene(.streets, photos: 30).features
    var options = Self.options(partners: 0)
    options.positionPartners = 2
    let positions = features.indices.map { photo in
      photo == 7
        ? nil
        : GeographicPosition(
          latitudeDegrees: 60, longitudeDegrees: 10 + 1e-4 * Double(photo), altitude: nil)
    }
    let pairs = try PairSelection(options)
      .run(features, positions: positions, ordering: .unordered, StageContext()).pairs
    #expect(pairs.contains(PhotoPair(ID(2), ID(3))) && pairs.contains(PhotoPair(ID(6), ID(8))))
    #expect(!pairs.contains { $0.first.index == 7 || $0.second.index == 7 })
    #expect(pairs.allSatisfy { $0.second.index - $0.first.index <= 3 })
  }

  @Test func preemptiveMatchingRejectsUnrelatedPhotosAndKeepsNeighbors() throws {
    let scene = try Self.scene(.streets, photos: 40, isShuffled: false)
    var options = PreemptiveMatching.Options()
    options.features = 400
    let pairs = (2..<40).flatMap {
      [PhotoPair(ID($0), ID($0 - 2)), PhotoPair(ID($0), ID(($0 + 20) % 40))]
    }
    let promising = Set(
      try PreemptiveMatching(options).run(pairs, features: scene.features, StageContext()))
    let overlaps = scene.overlaps(minimum: 1)
    #expect(pairs.allSatisfy { (overlaps[$0] ?? 0) < 100 || promising.contains($0) })
    let unrelatedPairs = pairs.filter { overlaps[$0] == nil }
    #expect(unrelatedPairs.count > 20)
    #expect(unrelatedPairs.count { promising.contains($0) } * 10 < unrelatedPairs.count)
  }

  @Test func partnersOfPartnersAreFound() throws {
    let verified = [(0, 1), (0, 2), (1, 3), (2, 3), (3, 4)].map { first, second in
      VerifiedPair(
        pair: PhotoPair(ID(first), ID(second)), model: .essential, secondFromFirst: nil,
        matches: [], medianAngle: 0)
    }
    let pairs = verified.map(\.pair)
    let choice = PairSelection.Choice(
      pairs: pairs, candidates: pairs, mostSimilar: [[Int]](repeating: [], count: 5),
      ordering: .unordered)
    var options = PairExpansion.Options()
    options.minimumPartners = 0
    let more = try PairExpansion(options).run(
      choice, ViewGraph(photoCount: 5, pairs: verified),
      features: [FeatureSet](repeating: FeatureSet(), count: 5),
      preemptiveMatching: PreemptiveMatching(),
      StageContext())
    #expect(more == [PhotoPair(ID(0), ID(3)), PhotoPair(ID(1), ID(2))])
  }

  @Test func rejectedPairsOfIsolatedPhotosAreRetried() throws {
    let pair = PhotoPair(ID(0), ID(2))
    let choice = PairSelection.Choice(
      pairs: [PhotoPair(ID(0), ID(1))], candidates: [PhotoPair(ID(0), ID(1)), pair],
      mostSimilar: [],
      ordering: .unordered)
    let features = [FeatureSet](repeating: FeatureSet(), count: 3)
    let more = try PairExpansion().run(
      choice, ViewGraph(photoCount: 3, pairs: []), features: features,
      preemptiveMatching: PreemptiveMatching(),
      StageContext())
    #expect(more == [pair])
  }
}
