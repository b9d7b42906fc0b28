import Foundation
import Kernels
import SceneModel

/// Aligns photos between which the object was moved, for instance laid on another side to show its
/// underside.
///
/// What the photos of one placement show is rigid: the object is masked in their part of the map.
/// All photos are then aligned by the masked object, which joins the placements, and masked again,
/// now that each side of the object is known from the photos that show it best.
struct MovedObjectAlignment {
  struct Options: Hashable, Codable, Sendable {
    var join = PlacementJoin.Options()
    /// Duration of the alignment of an object that moves, relative to that of a scene that stands
    /// still. Measured: with two threads, 1.43 for a flower pot on a turntable, 1.48 for
    /// MicroPasts' axe.
    var relativeDuration = 1.5

    init() {}
  }

  var options = Options()
  var alignment: ImageAlignment
  var masking: ObjectMasking

  /// Aligns photos without masks. `folder` receives the masks of an object that was moved.
  func run(_ photos: PhotoSet, folder: URL, _ context: StageContext) throws -> AlignedPhotos {
    var matched = try alignment.match(
      photos: photos.ingested.photos, cameras: photos.ingested.cameras, images: photos.images,
      context.part(from: 0, to: 0.7))
    var map = Result {
      try alignment.map(matched, images: photos.images, context.part(from: 0.7, to: 0.87))
    }
    if case .failure(let error) = map, !(error is PipelineError) { throw error }
    var rest: StageContext?
    if let first = try? map.get() {
      let (mapped, remaining) = try alignment.resolveRepetition(
        of: .init(matched: matched, map: first), photos.images, context, after: 0.87)
      (matched, map, rest) = (mapped.matched, .success(mapped.map), remaining)
    }
    let placements = placements((try? map.get())?.findings, matched.graph)
    var joiningContext = rest ?? context.part(from: 0.87, to: 1)
    if placements.count > 1 || matched.graph.omitsSurroundings {
      joiningContext = rest ?? context.extended(by: options.relativeDuration, after: 0.87)
      let share = joiningContext.part(from: 0, to: 0.9)
      if let joined = try join(
        placements, &matched, try? map.get(), photos, folder: folder, share)
      {
        return joined
      }
      joiningContext = joiningContext.part(from: 0.9, to: 1)
    }
    let rigid = try alignment.finish(
      rigid: try map.get(), matched, photos.images, joiningContext
    ) { try masking.coarseCloud($0, photos.images, $1) }
    if placements.count > 1 {
      context.notes.flagAsSuspect(
        "The object was moved between photos (\(placements.count) groups), but its sides could not "
          + "be joined: the model may show parts of it, or its surroundings. Take more photos of "
          + "what both sides share, or fill the frame with the object.")
    }
    return AlignedPhotos(reconstruction: rigid)
  }

  /// The placements by a map and by pairs of photos, or by these alone.
  private func placements(
    _ findings: SceneAmbiguityCheck.Findings?, _ graph: ViewGraph
  ) -> [[Int]] {
    if let found = findings?.placements, found.areSeveral || graph.placements.isEmpty {
      return found.groups
    }
    return graph.placements
  }

  /// All photos, aligned by the object that each placement's photos show; nil if that joins fewer
  /// than two placements. Records nothing but the notes of the last alignment.
  private func join(
    _ placements: [[Int]], _ matched: inout ImageAlignment.MatchedPhotos,
    _ map: ImageAlignment.Map?, _ photos: PhotoSet, folder: URL, _ context: StageContext
  ) throws -> AlignedPhotos? {
    guard !placements.isEmpty else { return nil }
    let maskedPlacements = try maskedPlacements(
      placements, matched, map, photos.images, context.part(from: 0, to: 0.4))
    guard matched.graph.isMotionExplained(by: maskedPlacements.count) else { return nil }
    var first = ObjectMasking.Result(photoCount: matched.photos.count)
    for placement in maskedPlacements { first.complete(with: placement.masks) }
    let masked = photos.masked(
      by: try EstimatedMasks(first, of: photos.ingested.photos, in: folder, context.control).masks)
    let join = PlacementJoin(
      options: options.join, alignment: alignment, masked: masked, masks: first.masks,
      placements: placements, maskedPlacements: maskedPlacements)
    guard let (joined, notes) = try join.run(&matched, map, context.part(from: 0.4, to: 0.8))
    else { return nil }
    var reconstruction = joined
    context.notes.add(notes)
    report(maskedPlacements.map(\.photos).filter { reconstruction.contains($0) }, context.notes)
    var prior = MaskPrior(matched.graph, features: matched.features)
    prior.placements = try maskedPlacements.compactMap {
      try $0.prior(in: reconstruction, masked.images)
    }
    for index in reconstruction.photos.indices { reconstruction.photos[index].mask = nil }
    let last = try masking.run(
      reconstruction, images: photos.images, prior: prior,
      StageContext(control: context.control.part(from: 0.8, to: 1)))
    var masks = last ?? first
    masks.complete(with: first)
    return AlignedPhotos(
      reconstruction: reconstruction,
      masks: try EstimatedMasks(masks, of: photos.ingested.photos, in: folder, context.control))
  }

  /// The placements whose photos show a separate object.
  private func maskedPlacements(
    _ placements: [[Int]], _ matched: ImageAlignment.MatchedPhotos, _ map: ImageAlignment.Map?,
    _ images: ImageStore, _ context: StageContext
  ) throws -> [MaskedPlacement] {
    let share = 1 / Double(placements.count)
    return try placements.enumerated().compactMap { number, photos in
      // The notes are those of the alignment of all photos.
      try maskedPlacement(
        photos, matched, map, images,
        StageContext(
          control: context.control.part(
            from: share * Double(number), to: share * Double(number + 1))))
    }
  }

  private func report(_ placements: [[Int]], _ notes: StageNotes) {
    notes.record("joinedPlacements", Double(placements.count))
    let counts = placements.map { String($0.count) }.joined(separator: ", ")
    notes.log(
      placements.count > 1
        ? "The object was moved between photos: \(placements.count) placements of \(counts) photos "
          + "were joined."
        : "The object moves in front of its surroundings: the photos were aligned by the object.")
  }

  /// The photos of one placement with their masks; nil if they show no separate object.
  private func maskedPlacement(
    _ photos: [Int], _ matched: ImageAlignment.MatchedPhotos, _ map: ImageAlignment.Map?,
    _ images: ImageStore, _ context: StageContext
  ) throws -> MaskedPlacement? {
    do {
      var alignment = alignment
      // Each placement stands as it stood; only the finished model is turned.
      if case .model = alignment.options.worldAlignment.chosenUp {
        alignment.options.worldAlignment.chosenUp = nil
      }
      let reconstruction = try alignment.reconstruction(
        of: photos, matched, map?.reconstruction, context.part(from: 0, to: 0.4))
      var masking = masking
      masking.options.isolation.showsOnlyObject = matched.graph.omitsSurroundings
      return try masking.run(
        reconstruction, images: images,
        prior: MaskPrior(matched.graph, features: matched.features),
        context.part(from: 0.4, to: 1)
      ).map { MaskedPlacement(photos: photos, poses: reconstruction.poses, masks: $0) }
    } catch is PipelineError {
      return nil
    }
  }
}
