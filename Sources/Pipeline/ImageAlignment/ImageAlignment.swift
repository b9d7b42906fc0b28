import Kernels
import SceneModel

/// Structure from motion: from photos to cameras, poses and sparse points in the common world
/// frame.
package struct ImageAlignment: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Whether the photos are in the order of capture.
    package var ordering = SampleOrdering.unordered
    /// Ratio of the ratio test at high `features.sensitivity`. Faint features are less distinctive;
    /// false matches that pass are left to geometric verification. Paper: Lowe 2004, section 7.1.
    package var highSensitivityRatio = 0.8
    /// Minimum number of registered photos; fewer are an error.
    package var minimumPhotos = PipelineError.minimumPhotos
    package var features = FeatureExtraction.Options()
    package var correspondences = CorrespondenceSearch.Options()
    package var pureRotation = PureRotationCheck.Options()
    package var mapping = SparseMapping.Options()
    package var sceneAmbiguity = SceneAmbiguityCheck.Options()
    /// Minimum number of photos that a consistent map must register to replace one that may be
    /// wrong, as a share of that one's. Chosen: a tenth of the photos for certainty.
    var replacingShare = 0.9
    var repetition = RepetitionOptions()
    /// Nil if photos may be aligned by the surroundings of the object.
    var focus: FocusCheck.Options? = FocusCheck.Options()
    package var refinement = ObservationRefinement.Options()
    package var worldAlignment = WorldAlignment.Options()

    package init() {}

    /// The options of the search at the features' sensitivity.
    var search: CorrespondenceSearch.Options {
      var search = correspondences
      if features.sensitivity == .high { search.matching.matching.ratio = highSensitivityRatio }
      return search
    }
  }

  package var options: Options
  /// Features, pairs and matches that other processes have made.
  var units: UnitStore?

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the largest reconstruction of the photos; `unregistered` gives the reasons why the
  /// others are missing. Throws `PipelineError.alignmentFailed` if no usable reconstruction exists.
  package func run(
    photos: [Photo], cameras: [Camera], images: ImageStore, _ context: StageContext
  ) throws -> Reconstruction {
    let matched = try match(
      photos: photos, cameras: cameras, images: images, context.part(from: 0, to: 0.7))
    let map = try map(matched, images: images, context.part(from: 0.7, to: 0.87))
    let (mapped, rest) = try resolveRepetition(
      of: MappedPhotos(matched: matched, map: map), images, context, after: 0.87)
    return try finish(
      rigid: mapped.map, mapped.matched, images, rest ?? context.part(from: 0.87, to: 1))
  }

  /// Finishes the map of a scene that may be rigid, and checks it. `denseCloud` makes a cloud that
  /// the check may need.
  func finish(
    rigid map: Map, _ matched: MatchedPhotos, _ images: ImageStore, _ context: StageContext,
    denseCloud: (Reconstruction, StageContext) throws -> PointCloud? = { _, _ in nil }
  ) throws -> Reconstruction {
    try throwOrWarn(map, context.notes)
    let result = try finish(
      map.reconstruction, matched, images, context.part(from: 0, to: 0.9))
    try checkFocus(of: result, matched, context.notes) {
      try denseCloud(result, context.part(from: 0.9, to: 1))
    }
    return result
  }

  /// Records a concern if the photos were aligned by something else than what they are aimed at.
  func checkFocus(
    of reconstruction: Reconstruction, _ matched: MatchedPhotos, _ notes: StageNotes,
    denseCloud: () throws -> PointCloud?
  ) rethrows {
    guard let focus = options.focus else { return }
    try FocusCheck(options: focus).run(
      reconstruction, matched.features, notes, denseCloud: denseCloud)
  }

  /// Photos with their features and verified pairs.
  struct MatchedPhotos: Sendable {
    var photos: [Photo]
    /// Initial cameras, with focal lengths from self-calibration.
    var cameras: [Camera]
    var features: [FeatureSet]
    var graph: ViewGraph
  }

  /// A map of the photos, and the signs that parts of it are superimposed.
  struct Map: Sendable {
    /// Not refined yet, in the frame of one of the photos.
    var reconstruction: Reconstruction
    /// Nil if the check failed.
    var findings: SceneAmbiguityCheck.Findings?

    /// Whether there is a sign that parts are superimposed.
    var mayBeWrong: Bool { findings.map { $0.verdict != .consistent } ?? false }
    /// Whether the object seems to have been moved between photos.
    var hasSeveralPlacements: Bool { findings?.placements.areSeveral ?? false }

    /// Whether this map is to replace one that may be wrong: it is consistent, and registers at
    /// least this share of the photos, unless the other map is of no use.
    func replaces(_ other: Map, minimumShare: Double) -> Bool {
      guard findings?.verdict == .consistent else { return false }
      return other.findings?.verdict == .inconsistent
        || Double(reconstruction.registered.count) >= minimumShare
          * Double(other.reconstruction.registered.count)
    }
  }

  /// Extracts and matches features. Throws `PipelineError.alignmentFailed` if no two photos match.
  func match(
    photos: [Photo], cameras: [Camera], images: ImageStore, _ context: StageContext
  ) throws -> MatchedPhotos {
    try PipelineError.checkCount(photos.count, needed: options.minimumPhotos)
    let matched = try viewGraph(photos: photos, cameras: cameras, images: images, context)
    guard !matched.graph.pairs.isEmpty else {
      throw PipelineError.alignmentFailed(reason: "no two photos show the same surface.")
    }
    return matched
  }

  /// Extracts and matches features; the graph may have no pairs.
  func viewGraph(
    photos: [Photo], cameras: [Camera], images: ImageStore, _ context: StageContext
  ) throws -> MatchedPhotos {
    var extraction = FeatureExtraction(options.features)
    extraction.units = units
    let features = try context.notes.step("features") {
      try extraction.run(
        photos, images: decodingOnce(images), context.part(from: 0, to: 0.55))
    }
    var search = CorrespondenceSearch(options.search)
    search.units = try units.map {
      try correspondenceUnits($0, photos: photos, images: images)
    }
    let (graph, calibrated) = try context.notes.step("matching") {
      try search.run(
        photos: photos, cameras: cameras, features: features, ordering: options.ordering,
        context.part(from: 0.55, to: 1))
    }
    context.notes.record(MatchRecord(features, graph))
    return MatchedPhotos(photos: photos, cameras: calibrated, features: features, graph: graph)
  }

  /// Maps matched photos, and checks the map. Throws `PipelineError.alignmentFailed` if there is no
  /// map, but not if parts of it are superimposed.
  ///
  /// Global mapping is the first choice, and incremental mapping the other, unless the relative
  /// rotations that global mapping starts from contradict each other: then it is the reverse. The
  /// other is tried if nothing was moved and the matches contradict the first: two groups with few
  /// links between them may have been joined in the wrong place.
  func map(
    _ matched: MatchedPhotos, images: ImageStore, _ context: StageContext
  ) throws -> Map {
    let isPureRotation = PureRotationCheck(options.pureRotation).isPureRotation(
      matched.graph, features: matched.features, photos: matched.photos, cameras: matched.cameras)
    guard !isPureRotation else {
      throw PipelineError.alignmentFailed(
        reason: "all photos were taken from one place; walk around the object between photos.")
    }
    let first = context.part(from: 0, to: 0.8)
    let second = context.part(from: 0.8, to: 1)
    guard options.mapping.method == .automatic else {
      return try map(matched, by: options.mapping.method, images, first).map
    }
    let mapping = SparseMapping(options.mapping)
    let isGlobalFirst = try context.notes.step("mapping") {
      try mapping.rotationsAgree(
        matched.graph, features: matched.features, photos: matched.photos,
        cameras: matched.cameras, first)
    }
    guard isGlobalFirst else {
      return try incrementalMap(matched, images, first) {
        !$0.mayBeWrong && mapping.isLarge($0.reconstruction, of: matched.graph)
      } ?? map(matched, by: .automatic, images, second).map
    }
    let (map, method) = try map(matched, by: .automatic, images, first)
    guard method == .global, map.mayBeWrong, !map.hasSeveralPlacements else { return map }
    return try incrementalMap(matched, images, second) {
      $0.replaces(map, minimumShare: options.replacingShare)
    } ?? map
  }

  /// A map of photos for which a global map may be wrong; nil if there is none that is accepted.
  private func incrementalMap(
    _ matched: MatchedPhotos, _ images: ImageStore, _ context: StageContext,
    isAccepted: (Map) -> Bool
  ) throws -> Map? {
    let attempt = StageContext(
      control: context.control, notes: StageNotes(meter: context.notes.meter))
    do {
      let (map, _) = try forAlternatives.map(matched, by: .incremental, images, attempt)
      guard isAccepted(map) else { return nil }
      context.notes.add(attempt.notes)
      return map
    } catch is PipelineError {
      return nil
    }
  }

  /// Alignment by a map instead of one that may be wrong. That the photos are ambiguous is known
  /// then, so a single contradiction suffices, if the shares are reached, to reject it as well.
  var forAlternatives: ImageAlignment {
    var result = self
    result.options.sceneAmbiguity.minimumConflicts = 1
    result.options.sceneAmbiguity.minimumContradicted = 1
    return result
  }

  /// Maps matched photos by one method, and checks the map. Also returns the method that was used.
  private func map(
    _ matched: MatchedPhotos, by method: MappingMethod, _ images: ImageStore,
    _ context: StageContext
  ) throws -> (map: Map, method: MappingMethod) {
    var mapping = SparseMapping(options.mapping)
    mapping.options.method = method
    let (mapped, used) = try context.notes.step("mapping") {
      try mapping.map(
        matched.graph, features: matched.features, photos: matched.photos,
        cameras: matched.cameras, context.part(from: 0, to: 0.9))
    }
    try check(mapped, context.notes)
    let findings = try context.notes.step("ambiguityCheck") {
      try ambiguityFindings(mapped, matched, images, context.part(from: 0.9, to: 1))
    }
    return (Map(reconstruction: mapped, findings: findings), used)
  }

  /// A reconstruction of some of the photos in the world frame, not refined: their part of a map of
  /// all photos, if it agrees with the matches between them, or else a map of their own.
  func reconstruction(
    of group: [Int], _ matched: MatchedPhotos, _ map: Reconstruction?, _ context: StageContext
  ) throws -> Reconstruction {
    let graph = matched.graph.restricted(to: group)
    if let part = map?.restricted(to: group),
      Double(part.registered.count) >= options.mapping.minimumShare * Double(group.count),
      graph.contradicted(by: part, features: matched.features, options.sceneAmbiguity).isEmpty
    {
      return placed(part, hasMasks: false, context)
    }
    let mapped = try SparseMapping(options.mapping).run(
      graph, features: matched.features, photos: matched.photos, cameras: matched.cameras,
      context.part(from: 0, to: 0.9))
    try check(mapped, context.notes)
    return placed(mapped, hasMasks: false, context.part(from: 0.9, to: 1))
  }

  /// Refines the observations and moves the reconstruction, with some of the points, to the world
  /// frame. `posesInUpFrame` has poses of photos in a frame whose +y is up.
  func finish(
    _ mapped: Reconstruction, _ matched: MatchedPhotos, _ images: ImageStore,
    posesInUpFrame: [RigidTransform?] = [], _ context: StageContext,
    keeping isKept: (ScenePoint) -> Bool = { _ in true }
  ) throws -> Reconstruction {
    var refined = try context.notes.step("refinement") {
      try refine(
        mapped, matched.features, matched.cameras, decodingOnce(images),
        context.part(from: 0, to: 0.85))
    }
    refined.points = refined.points.filter(isKept)
    let reconstruction = placed(
      refined, posesInUpFrame: posesInUpFrame, hasMasks: images.hasMasks,
      context.part(from: 0.85, to: 1))
    report(reconstruction, context.notes)
    try context.control.step(1)
    return reconstruction
  }

  /// The reconstruction in the world frame. Masks, if any, exclude the support.
  private func placed(
    _ reconstruction: Reconstruction, posesInUpFrame: [RigidTransform?] = [], hasMasks: Bool,
    _ context: StageContext
  ) -> Reconstruction {
    var worldAlignment = options.worldAlignment
    let masks = hasMasks ? reconstruction.photos.count { $0.mask != nil } : 0
    worldAlignment.findsSupport =
      worldAlignment.findsSupport && 2 * masks < reconstruction.photos.count
    return WorldAlignment(worldAlignment).run(
      reconstruction, posesInUpFrame: posesInUpFrame, context)
  }

  /// The photos, decoded once for features and refinement.
  private func decodingOnce(_ images: ImageStore) -> ImageStore {
    let sizes = [options.features.photoPixels, options.refinement.workingPixels]
    return sizes[0] == sizes[1]
      ? images : images.decodingOnce(forSizesUpTo: max(sizes[0], sizes[1]))
  }

  /// The reconstruction with refined observations, or the unrefined one if refinement fails.
  private func refine(
    _ mapped: Reconstruction, _ features: [FeatureSet], _ cameras: [Camera], _ images: ImageStore,
    _ context: StageContext
  ) throws -> Reconstruction {
    do {
      return try ObservationRefinement(options.refinement)
        .run(mapped, features: features, cameras: cameras, images: images, context)
    } catch let error as KernelError where error != .outOfMemory {
      context.notes.warn(
        "The observations could not be refined (\(error)); poses are less accurate.")
      return mapped
    }
  }

  /// The signs that the map superimposes repeated structures of the scene; nil if the check fails.
  private func ambiguityFindings(
    _ mapped: Reconstruction, _ matched: MatchedPhotos, _ images: ImageStore,
    _ context: StageContext
  ) throws -> SceneAmbiguityCheck.Findings? {
    do {
      return try SceneAmbiguityCheck(options.sceneAmbiguity)
        .run(
          mapped, matched.graph, features: matched.features, images: decodingOnce(images),
          neededPoints: options.mapping.incremental.minimumInliers, context)
    } catch let error as KernelError where error != .outOfMemory {
      context.notes.warn("The scene was not checked for repeated structure (\(error)).")
      return nil
    }
  }

  /// Throws if a map superimposes repeated structures of the scene, and warns if it may.
  func throwOrWarn(_ map: Map, _ notes: StageNotes) throws {
    guard let findings = map.findings else { return }
    let photos = map.reconstruction.photos
    switch findings.verdict {
    case .consistent: break
    case .ambiguous:
      notes.warn(
        "The model may superimpose similar parts of the scene: "
          + "\(findings.reason(photos)). Check the model; \(Self.ambiguityAdvice)")
    case .inconsistent:
      throw PipelineError.alignmentFailed(
        reason: "similar parts of the scene can't be distinguished: "
          + "\(findings.reason(photos)); \(Self.ambiguityAdvice)")
    }
  }

  private static let ambiguityAdvice =
    "place distinctive objects around the subject, step back so that photos show them, or leave "
    + "out the photos of one of the similar parts."

  /// Throws if the reconstruction has too few photos or no points.
  private func check(_ reconstruction: Reconstruction, _ notes: StageNotes) throws {
    let count = reconstruction.registered.count
    if count >= options.minimumPhotos, !reconstruction.points.isEmpty { return }
    reconstruction.unregistered.forEach { notes.warn($0.reason) }
    let photos = reconstruction.photos.count
    throw PipelineError.alignmentFailed(
      reason: count > 0
        ? "only \(count) of the \(photos) photos see enough of the same surface."
        : "no pair of the \(photos) photos shows a surface from two different places.")
  }

  private func report(_ reconstruction: Reconstruction, _ notes: StageNotes) {
    let points = reconstruction.points
    let observations = points.reduce(0) { $0 + $1.track.count }
    notes.record("registered", Double(reconstruction.registered.count))
    notes.record("points", Double(points.count))
    notes.record("observations", Double(observations))
    notes.record("meanReprojectionError", reconstruction.meanReprojectionError)
    notes.record("meanTrackLength", Double(observations) / Double(max(1, points.count)))
    let missing = reconstruction.unregistered.count
    if missing > 0 {
      notes.warn(
        "\(missing) of \(reconstruction.photos.count) photos could not be aligned with the others.")
    }
  }
}
