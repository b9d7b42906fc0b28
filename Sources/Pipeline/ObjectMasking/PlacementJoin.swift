import Kernels
import SceneModel

/// The alignment of all photos by the object that their masks leave, which joins the placements.
struct PlacementJoin {
  typealias MatchedPhotos = ImageAlignment.MatchedPhotos

  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of photos that the joined alignment must register, as a share of those of the
    /// largest placement. Chosen.
    var minimumShare = 0.9
    /// If the alignment by the object misses more than this share of the photos, it is repeated
    /// with more features, which takes three to four times as long. Chosen.
    var acceptedLoss = 1.0 / 30

    init() {}
  }

  var options = Options()
  var alignment: ImageAlignment
  /// The photos with the masks of their placements.
  var masked: PhotoSet
  /// The masks, by photo ID.
  var masks: [RasterImage?]
  /// All placements, and those whose photos show a separate object.
  var placements: [[Int]]
  var maskedPlacements: [MaskedPlacement]

  /// An alignment of all photos, with its notes.
  typealias Joined = (reconstruction: Reconstruction, notes: StageNotes)

  /// Returns nil if too little is joined. `map` is that of all photos.
  ///
  /// An object that is small in the photos has few of their features: then more are extracted from
  /// the masked photos, and once more, with high sensitivity, if too many photos are missing. That
  /// releases the descriptors of `matched`.
  func run(
    _ matched: inout MatchedPhotos, _ map: ImageAlignment.Map?, _ context: StageContext
  ) throws -> Joined? {
    let object = try ObjectFeatures(
      matched.features, photos: masked.ingested.photos, masks: masks,
      margin: alignment.options.features.maskMargin, context.control.part(from: 0, to: 0.02))
    let sensitivity = alignment.options.features.sensitivity
    let share = context.part(from: 0.02, to: 0.5)
    let first =
      object.medianCount < alignment.options.features.sparseFeatures
      ? try attempt(extractingAgain: sensitivity, &matched, share)
      : try attempt(share) { [matched] context in
        if let map, isSufficient(map, matched) { return (matched, object, map) }
        let result = try alignment.match(
          object, of: matched, placements: placements, context.part(from: 0, to: 0.6))
        return (result, object, try objectMap(result, context))
      }
    let count = first?.reconstruction.registered.count ?? 0
    guard isIncomplete(count, matched), sensitivity != .high else { return first }
    let second = try attempt(extractingAgain: .high, &matched, context.part(from: 0.5, to: 1))
    return second?.reconstruction.registered.count ?? 0 > count ? second : first
  }

  private func attempt(
    extractingAgain sensitivity: FeatureSensitivity, _ matched: inout MatchedPhotos,
    _ context: StageContext
  ) throws -> Joined? {
    for index in matched.features.indices { matched.features[index].descriptors = [] }
    return try attempt(context) { [matched] context in
      let (result, object) = try alignment.match(
        masked, of: matched, placements: placements, sensitivity: sensitivity,
        context.part(from: 0, to: 0.6))
      return (result, object, try objectMap(result, context))
    }
  }

  private func isIncomplete(_ count: Int, _ matched: MatchedPhotos) -> Bool {
    let photos = Double(matched.photos.count)
    return photos - Double(count) > options.acceptedLoss * photos
  }

  /// Whether the map of all photos joins them by the object: it was made of matches of the object
  /// only, and all agree on one placement.
  private func isSufficient(_ map: ImageAlignment.Map, _ matched: MatchedPhotos) -> Bool {
    matched.graph.omitsSurroundings && placements.count == 1
      && !isIncomplete(map.reconstruction.registered.count, matched)
  }

  private func objectMap(
    _ matched: MatchedPhotos, _ context: StageContext
  ) throws -> ImageAlignment.Map {
    try alignment.map(matched, images: masked.images, context.part(from: 0.6, to: 0.85))
  }

  /// Matches and maps the photos by `make`, and finishes the map; nil if that joins too little.
  private func attempt(
    _ context: StageContext,
    _ make: (StageContext) throws -> (MatchedPhotos, ObjectFeatures, ImageAlignment.Map)
  ) throws -> Joined? {
    let context = StageContext(control: context.control)
    do {
      let (matched, object, map) = try make(context)
      try alignment.throwOrWarn(map, context.notes)
      let result = try alignment.finish(
        map, of: object, matched, masked.images, posesInUpFrame: posesInUpFrame,
        context.part(from: 0.85, to: 1))
      return isAccepted(result, matched.graph) ? (result, context.notes) : nil
    } catch let error as PipelineError {
      context.notes.log("The placements of the object were not joined: \(error)")
      return nil
    }
  }

  private func isAccepted(_ result: Reconstruction, _ graph: ViewGraph) -> Bool {
    let largest = placements.map(\.count).max() ?? 0
    return graph.isMotionExplained(by: maskedPlacements.count { result.contains($0.photos) })
      && Double(result.registered.count) >= options.minimumShare * Double(largest)
  }

  /// The poses of the largest placement: the object stands in the model as it stood there.
  private var posesInUpFrame: [RigidTransform?] {
    let largest = maskedPlacements.enumerated().max {
      ($0.element.photos.count, $1.offset) < ($1.element.photos.count, $0.offset)
    }
    return largest?.element.poses ?? []
  }
}

extension ViewGraph {
  /// Whether this number of placements explains that the object moves: one does if all photos agree
  /// on it.
  func isMotionExplained(by placementCount: Int) -> Bool {
    placementCount >= (omitsSurroundings ? 1 : 2)
  }
}

extension Reconstruction {
  /// Whether one of the photos is registered.
  func contains(_ photos: [Int]) -> Bool { photos.contains { poses[$0] != nil } }
}
