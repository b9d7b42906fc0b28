import Kernels
import SceneModel

/// Parts of an alignment that processes of their own make: features, pairs and matches. What they
/// leave in the store of units is what `ImageAlignment` finds there.
struct AlignmentParts {
  let alignment: ImageAlignment
  let store: UnitStore
  let photos: [Photo]
  let cameras: [Camera]
  let images: ImageStore

  private var extraction: FeatureExtraction {
    var extraction = FeatureExtraction(alignment.options.features)
    extraction.units = store
    return extraction
  }

  /// Extracts the features of a block of the photos.
  func makeFeatures(of block: Block, _ context: StageContext) throws {
    _ = try extraction.run(
      Array(photos[block.range(of: photos.count)]), images: images, context)
  }

  /// Finds the pairs that are considered.
  func findCandidates(_ context: StageContext) throws {
    _ = try candidates(context)
  }

  private func candidates(_ context: StageContext) throws -> PairSelection.Candidates {
    try units().candidates {
      let features = try extraction.run(photos, images: images, context.part(from: 0, to: 0.5))
      return try selection.candidates(
        features, positions: photos.map(\.position), ordering: alignment.options.ordering,
        context.part(from: 0.5, to: 1))
    }
  }

  /// Tests a block of the pairs that are considered.
  func test(_ block: Block, _ context: StageContext) throws {
    let tested = try candidates(context.part(from: 0, to: 0.1)).tested
    try forEachRange(of: block, of: tested, context.part(from: 0.1, to: 1)) {
      _ = try promising(tested, $0, $1)
    }
  }

  /// Calls `body` for each range of pairs that are stored together, of a block of all.
  private func forEachRange(
    of block: Block, of pairs: [PhotoPair], _ context: StageContext,
    _ body: (Range<Int>, StageContext) throws -> Void
  ) throws {
    let ranges = MatchBlock.ranges(of: pairs)
    let own = ranges[block.range(of: ranges.count)]
    for (number, range) in own.enumerated() {
      try body(range, context.part(number, of: own.count))
    }
  }

  private func promising(
    _ tested: [PhotoPair], _ range: Range<Int>, _ context: StageContext
  ) throws -> [PhotoPair] {
    try units().promising(range) {
      let pairs = tested[range]
      let features = try features(of: pairs, context.part(from: 0, to: 0.2))
      return try selection.test(
        Array(pairs), features: features, context.part(from: 0.2, to: 1))
    }
  }

  /// The pairs to match first.
  private func choice(_ context: StageContext) throws -> PairSelection.Choice {
    try units().choice {
      let candidates = try candidates(context.part(from: 0, to: 0.2))
      let ranges = MatchBlock.ranges(of: candidates.tested)
      let passing = try ranges.indices.flatMap { index in
        try promising(
          candidates.tested, ranges[index],
          context.part(from: 0.2, to: 1).part(index, of: ranges.count))
      }
      return selection.choice(of: candidates, promising: passing)
    }
  }

  private var selection: PairSelection {
    PairSelection(alignment.options.search.selection)
  }

  private func units() throws -> CorrespondenceUnits {
    try alignment.correspondenceUnits(store, photos: photos, images: images)
  }

  /// Chooses the pairs that follow from the matches of the first ones.
  func selectMorePairs(_ context: StageContext) throws {
    _ = try morePairs(context)
  }

  private func morePairs(_ context: StageContext) throws -> [PhotoPair] {
    var search = CorrespondenceSearch(alignment.options.search)
    let units = try units()
    search.units = units
    return try units.morePairs(search.options, cameras: cameras, photos: photos) {
      let features = try extraction.run(photos, images: images, context.part(from: 0, to: 0.5))
      return try search.morePairs(
        photos: photos, cameras: cameras, features: features, ordering: alignment.options.ordering,
        context.part(from: 0.5, to: 1))
    }
  }

  /// Matches a block of the first pairs.
  func match(_ block: Block, _ context: StageContext) throws {
    try match(block, of: try choice(context.part(from: 0, to: 0.1)).pairs, context)
  }

  /// Matches a block of the pairs that follow from the first ones.
  func matchMore(_ block: Block, _ context: StageContext) throws {
    try match(block, of: try morePairs(context.part(from: 0, to: 0.1)), context)
  }

  /// Matches and verifies a block of some pairs. Reads the features of a part of the photos at a
  /// time.
  private func match(_ block: Block, of pairs: [PhotoPair], _ context: StageContext) throws {
    let units = try units()
    let matching = alignment.options.search.pairMatching(photos: photos, cameras: cameras)
    let key = try matching.fingerprint
    try forEachRange(of: block, of: pairs, context.part(from: 0.1, to: 1)) { range, part in
      _ = try units.block(pairs[range], madeFrom: key) {
        let features = try features(of: pairs[range], part.part(from: 0, to: 0.2))
        return try matching.make(
          Array(pairs[range]), features: features, part.part(from: 0.2, to: 1))
      }
    }
  }

  /// The features of the photos of some pairs, by photo; empty for the others.
  private func features(
    of pairs: ArraySlice<PhotoPair>, _ context: StageContext
  ) throws -> [FeatureSet] {
    let needed = Set(pairs.flatMap { [$0.first, $0.second] }).sorted()
    let sets = try extraction.run(
      needed.map { photos[$0.index] }, images: images,
      StageContext(control: context.control))
    var features = [FeatureSet](repeating: FeatureSet(), count: photos.count)
    for (photo, set) in zip(needed, sets) { features[photo.index] = set }
    return features
  }
}

extension ImageAlignment {
  /// The units of the search for correspondences between some photos.
  func correspondenceUnits(
    _ store: UnitStore, photos: [Photo], images: ImageStore
  ) throws -> CorrespondenceUnits {
    let extraction = FeatureExtraction(options.features)
    return try CorrespondenceUnits(
      store, featureKeys: photos.map { try extraction.key(of: $0, images) },
      options.search.selection,
      ordering: options.ordering, positions: photos.map(\.position))
  }
}
