import Kernels
import SceneModel

/// From features to verified pairs: pair selection, matching, geometric verification, and
/// self-calibration of cameras without metadata.
package struct CorrespondenceSearch {
  package struct Options: Hashable, Codable, Sendable {
    package var selection = PairSelection.Options()
    /// Maximum fraction of the sampled rejections that may turn out verifiable. Above it,
    /// preemptive matching is considered unreliable and all candidates are matched. Chosen.
    package var maximumFalseRejectionRatio = 0.03
    /// If an object moves, matches of its surroundings are dropped, provided that at least this
    /// share of the connected photos stays connected. Measured: found on captures of seed 7
    /// (docs/experiments/2026-11-moving-objects.md).
    package var minimumObjectShare = 0.4
    /// Whether two photos without masks are matched even if others have masks. If the masks exclude
    /// surroundings that moved, such a pair would match these.
    var matchesUnmaskedPairs = true
    package var expansion = PairExpansion.Options()
    package var matching = FeatureMatching.Options()
    package var verification = PairVerification.Options()
    package var selfCalibration = SelfCalibration.Options()
    package var guidedMatching = GuidedMatching.Options()
    package var secondMotions = SecondMotionSearch.Options()
    var motionLayers = MotionLayers.Options()
    var placements = PlacementDetection.Options()

    package init() {}

    /// The matching of pairs with these options.
    func pairMatching(photos: [Photo], cameras: [Camera]) -> PairMatching {
      let verification = PairVerification(verification)
      return PairMatching(
        matching: FeatureMatching(matching), verification: verification,
        guidedMatching: GuidedMatching(guidedMatching, verification: verification),
        photos: photos, cameras: cameras)
    }
  }

  package var options: Options
  /// Pairs and matches that other processes have made or will need.
  var units: CorrespondenceUnits?

  package init(_ options: Options = Options()) { self.options = options }

  /// The pairs to match first.
  func choice(
    _ features: [FeatureSet], photos: [Photo], ordering: SampleOrdering, _ context: StageContext
  ) throws -> PairSelection.Choice {
    func make() throws -> PairSelection.Choice {
      try PairSelection(options.selection)
        .run(features, positions: photos.map(\.position), ordering: ordering, context)
    }
    return try units?.choice(make) ?? make()
  }

  /// Returns the verified pairs, and the cameras. A camera whose focal length was only assumed gets
  /// an improved initial value if the matches determine one.
  package func run(
    photos: [Photo], cameras: [Camera], features: [FeatureSet], ordering: SampleOrdering,
    _ context: StageContext
  ) throws -> (viewGraph: ViewGraph, cameras: [Camera]) {
    var matchedPairs = MatchedPairs(
      options: options, photos: photos, cameras: cameras, features: features)
    let choice = try matchFirst(&matchedPairs, ordering, context.part(from: 0, to: 0.65))
    let rest = context.part(from: 0.65, to: 0.7)
    func make() throws -> [PhotoPair] { try expansion(choice, matchedPairs, rest) }
    let more =
      try units?.morePairs(options, cameras: cameras, photos: photos, make) ?? make()
    try matchedPairs.add(more, units: units, context.part(from: 0.7, to: 0.9))
    let calibrated = try SelfCalibration(options.selfCalibration)
      .run(
        matchedPairs.graph, features: features, photos: photos, cameras: cameras,
        context.part(from: 0.9, to: 0.95))
    let known = zip(cameras, calibrated).map { $0 == $1 ? $1 : $1.withKnownFocalLength }
    if calibrated != cameras {
      try matchedPairs.verifyAgain(known, context.part(from: 0.95, to: 0.97))
    }
    try matchedPairs.guide(known, context.part(from: 0.97, to: 0.99))
    try matchedPairs.separateMotions(known, context.part(from: 0.99, to: 0.995))
    try matchedPairs.addWeakPairs(known, context.part(from: 0.995, to: 1))
    context.notes.record("candidatePairs", Double(Set(choice.candidates).union(more).count))
    matchedPairs.report(context.notes)
    return (matchedPairs.graph, calibrated)
  }

  /// The pairs that follow from the matches of the first ones.
  func morePairs(
    photos: [Photo], cameras: [Camera], features: [FeatureSet], ordering: SampleOrdering,
    _ context: StageContext
  ) throws -> [PhotoPair] {
    var matchedPairs = MatchedPairs(
      options: options, photos: photos, cameras: cameras, features: features)
    let choice = try matchFirst(&matchedPairs, ordering, context.part(from: 0, to: 0.9))
    return try expansion(choice, matchedPairs, context.part(from: 0.9, to: 1))
  }

  /// Matches and verifies the pairs to match first; returns them.
  private func matchFirst(
    _ matchedPairs: inout MatchedPairs, _ ordering: SampleOrdering, _ context: StageContext
  ) throws -> PairSelection.Choice {
    var choice = try choice(
      matchedPairs.features, photos: matchedPairs.photos, ordering: ordering,
      context.part(from: 0, to: 0.15))
    try matchedPairs.add(choice.pairs, units: units, context.part(from: 0.15, to: 0.75))
    if isPreemptiveMatchingUnreliable(choice, matchedPairs.graph) {
      let known = Set(choice.pairs)
      try matchedPairs.add(
        choice.candidates.filter { !known.contains($0) }, units: units,
        context.part(from: 0.75, to: 1))
      choice.pairs = choice.candidates
    }
    return choice
  }

  /// The pairs that follow from the first ones.
  private func expansion(
    _ choice: PairSelection.Choice, _ first: MatchedPairs, _ context: StageContext
  ) throws -> [PhotoPair] {
    try PairExpansion(options.expansion)
      .run(
        choice, first.graph, features: first.features,
        preemptiveMatching: PreemptiveMatching(options.selection.preemptiveMatching), context)
  }

  /// Whether preemptive matching rejected too many pairs that turned out to be verifiable.
  private func isPreemptiveMatchingUnreliable(_ choice: PairSelection.Choice, _ graph: ViewGraph)
    -> Bool
  {
    let verified = Set(graph.pairs.map(\.pair))
    let wrong = choice.sample.count { verified.contains($0) }
    return Double(wrong) > options.maximumFalseRejectionRatio * Double(choice.sample.count)
  }
}

/// The pairs matched and verified so far.
private struct MatchedPairs {
  let options: CorrespondenceSearch.Options
  let photos: [Photo]
  let cameras: [Camera]
  private(set) var features: [FeatureSet]
  private(set) var graph: ViewGraph
  private var verification: PairVerification.Options
  private var pairs: [PhotoPair] = []
  private var matches: [[FeatureMatch]] = []
  /// The pairs for which guided matching with `cameras` found more matches; nil if `features` has
  /// changed since, so that they must be found again.
  private var guided: [PhotoPair: VerifiedPair]? = [:]

  init(
    options: CorrespondenceSearch.Options, photos: [Photo], cameras: [Camera],
    features: [FeatureSet]
  ) {
    (self.options, self.photos, self.cameras, self.features) = (options, photos, cameras, features)
    graph = ViewGraph(photoCount: photos.count, pairs: [])
    verification = options.verification
  }

  /// Matches and verifies more pairs.
  mutating func add(
    _ candidates: [PhotoPair], units: CorrespondenceUnits? = nil, _ context: StageContext
  ) throws {
    let more = candidates.filter { pair in
      options.matchesUnmaskedPairs || photos[pair.first.index].mask != nil
        || photos[pair.second.index].mask != nil
    }
    guard !more.isEmpty else { return }
    let found = try options.pairMatching(photos: photos, cameras: cameras)
      .run(more, features: features, units: units, context)
    pairs += more
    matches += found.matches
    graph.add(found.verdicts)
    for pair in found.guided { guided?[pair.pair] = pair }
  }

  /// Verifies all pairs again, now that more focal lengths are known well enough for essential
  /// matrices.
  mutating func verifyAgain(_ cameras: [Camera], _ context: StageContext) throws {
    graph = try PairVerification(verification)
      .run(
        pairs, matches: matches, features: features, photos: photos, cameras: cameras, context)
  }

  /// Searches for additional matches of pairs with few of them along the epipolar lines, unless
  /// that was done with these cameras.
  mutating func guide(_ cameras: [Camera], _ context: StageContext) throws {
    guard cameras == self.cameras, let guided else {
      graph = try GuidedMatching(
        options.guidedMatching, verification: PairVerification(verification)
      ).run(graph, features: features, photos: photos, cameras: cameras, context)
      return
    }
    let known = graph.matchCount
    for index in graph.pairs.indices {
      if let better = guided[graph.pairs[index].pair] { graph.pairs[index] = better }
    }
    context.notes.record("guidedMatches", Double(graph.matchCount - known))
  }

  /// Adds the weak pairs of photos with few partners, unless something moves: a few matches may
  /// belong to the object or to its surroundings.
  mutating func addWeakPairs(_ cameras: [Camera], _ context: StageContext) throws {
    guard graph.motions.isEmpty, graph.placements.isEmpty, !graph.omitsSurroundings else { return }
    var weak = graph
    weak.pairs = graph.weakPairs(
      ofPhotosWithFewerPartnersThan: options.expansion.minimumPartners)
    context.notes.record("weakPairs", Double(weak.pairs.count))
    // Separate notes: the number of guided matches of the other pairs stays recorded.
    weak = try GuidedMatching(
      options.guidedMatching, verification: PairVerification(verification)
    ).run(
      weak, features: features, photos: photos, cameras: cameras,
      StageContext(control: context.control))
    graph.add(weak.pairs)
  }

  /// Searches for pairs between which an object moved relative to its surroundings; if it did, only
  /// matches of the object remain.
  mutating func separateMotions(_ cameras: [Camera], _ context: StageContext) throws {
    graph.motions = try SecondMotionSearch(
      options.secondMotions, verification: PairVerification(verification)
    ).run(
      pairs, matches: matches, graph: graph, features: features, photos: photos, cameras: cameras,
      context)
    context.notes.record("twoMotionPairs", Double(graph.motions.count))
    let surroundings = try MotionLayers(options: options.motionLayers)
      .surroundings(graph, features: features, photos: photos, context)
    guard let surroundings else { return }
    let placements = try PlacementDetection(options: options.placements)
      .groups(graph, context.control.part(from: 1, to: 1))
    if let placements {
      graph.placements = placements.groups
      placements.explanation.map(context.notes.log)
      return
    }
    let object = try objectPairs(without: surroundings, cameras, context)
    let connected = object.graph.connectedGroups[0].count
    guard
      Double(connected) >= options.minimumObjectShare * Double(graph.connectedGroups[0].count)
    else {
      context.notes.flagAsSuspect(
        "An object moves in front of its surroundings, but too few of its features match to align "
          + "the photos by it: the model shows the surroundings. Fill the frame with the object, "
          + "cover what is around it with a plain cloth, or give masks.")
      return
    }
    (pairs, matches, graph.pairs, graph.rejected) = (
      object.pairs, object.matches, object.graph.pairs, object.graph.rejected
    )
    graph.omitsSurroundings = true
    graph.surroundings = surroundings.hasFeature
    context.notes.record(
      "surroundingsFeatures",
      Double(surroundings.hasFeature.reduce(0) { $0 + $1.count { $0 } }))
  }

  /// The pairs matched again without the features of the surroundings: among fewer features, more
  /// matches are distinctive. Pairs with less than half of the matches that are needed are left out
  /// (chosen; the poses of a flower pot on a turntable are the same without them).
  private func objectPairs(
    without surroundings: MotionLayers.Surroundings, _ cameras: [Camera], _ context: StageContext
  ) throws -> MatchedPairs {
    let kept = surroundings.hasFeature.map { isExcluded in
      isExcluded.indices.filter { !isExcluded[$0] }
    }
    func original(_ match: FeatureMatch, _ pair: PhotoPair) -> FeatureMatch {
      FeatureMatch(
        first: Int32(kept[pair.first.index][Int(match.first)]),
        second: Int32(kept[pair.second.index][Int(match.second)]))
    }
    var object = self
    object.guided = nil
    object.features = zip(features, kept).map { $0.selecting($1) }
    let promising = zip(pairs, matches).filter { pair, matches in
      2 * matches.count { !surroundings.contain($0, of: pair) }
        >= verification.minimumInliers
    }
    object.pairs = promising.map(\.0)
    object.matches = zip(
      object.pairs,
      try FeatureMatching(options.matching).run(object.pairs, features: object.features, context)
    ).map { pair, matches in
      matches.filter { match in
        let match = original(match, pair)
        return !surroundings.contain(match, of: pair)
          && !(surroundings.areStatic && isStatic(match, of: pair))
      }
    }
    try object.verifyAgain(cameras, context)
    try object.guide(cameras, context)
    object.features = features
    object.matches = zip(object.pairs, object.matches).map { pair, matches in
      matches.map { original($0, pair) }
    }
    for index in object.graph.pairs.indices {
      let pair = object.graph.pairs[index]
      object.graph.pairs[index].matches = pair.matches.map { original($0, pair.pair) }
    }
    return object
  }

  /// Whether both photos show a match at the same pixel.
  private func isStatic(_ match: FeatureMatch, of pair: PhotoPair) -> Bool {
    features.displacement(of: match, in: pair)
      <= options.secondMotions.staticLimit(photos[pair.first.index])
  }

  /// Records the numbers of pairs and matches, and warns if no pair was verified.
  func report(_ notes: StageNotes) {
    notes.record("pairs", Double(pairs.count))
    notes.record("matches", Double(matches.reduce(0) { $0 + $1.count }))
    notes.record("verifiedPairs", Double(graph.pairs.count))
    notes.record("verifiedMatches", Double(graph.matchCount))
    if graph.pairs.isEmpty, graph.photoCount > 1 {
      notes.warn(
        "No two photos show the same surface; take photos that overlap by two thirds.")
    }
  }
}

extension Camera {
  /// The camera, for whose pairs essential matrices are estimated: the matches determined the focal
  /// length, whatever the metadata say.
  fileprivate var withKnownFocalLength: Camera {
    var result = self
    result.calibration = .exif
    return result
  }
}
