import Foundation
import Kernels
import SceneModel

/// Aligns photos between which the object was moved, for instance laid on another side to show its
/// underside.
///
/// What the photos of one placement show is rigid: they are aligned separately, and the object is
/// masked. All photos are then aligned by the masked object, which joins the placements.
struct MovedObjectAlignment {
  var alignment: ImageAlignment
  var masking: ObjectMasking

  /// Aligns photos without masks. `folder` receives the masks of an object that was moved.
  func run(_ photos: PhotoSet, folder: URL, _ context: StageContext) throws -> AlignedPhotos {
    let ingested = photos.ingested
    let map = try alignment.map(
      photos: ingested.photos, cameras: ingested.cameras, images: photos.images,
      context.part(from: 0, to: 0.5))
    let placements = map.findings?.placements ?? []
    if placements.count > 1 || map.graph.isObjectOnly && !placements.isEmpty {
      let notes = StageNotes()
      context.notes.log(
        "The photos show the object in \(placements.count) placements, of "
          + placements.map { String($0.count) }.joined(separator: ", ") + " photos.")
      let joined = try join(
        placements, map, photos, folder: folder,
        StageContext(control: context.part(from: 0.5, to: 1).control, notes: notes))
      if let joined {
        context.notes.add(notes)
        return joined
      }
    }
    try alignment.throwOrWarn(map, context.notes)
    return AlignedPhotos(
      reconstruction: try alignment.finish(
        map.reconstruction, map, photos.images, context.part(from: 0.5, to: 1)))
  }

  /// All photos, aligned by the object that each placement's photos show; nil if that joins fewer
  /// than two placements.
  private func join(
    _ placements: [[Int]], _ map: ImageAlignment.Map, _ photos: PhotoSet, folder: URL,
    _ context: StageContext
  ) throws -> AlignedPhotos? {
    var rough = ObjectMasking.Result(photoCount: photos.ingested.photos.count)
    for (number, placement) in placements.enumerated() {
      let share = 0.5 / Double(placements.count)
      let control = context.part(
        from: share * Double(number), to: share * Double(number + 1)
      ).control
      if let found = try masks(
        of: placement, map, photos.images, StageContext(control: control, notes: StageNotes()))
      {
        rough.add(found)
      }
    }
    let used = placements.filter { $0.contains { rough.masks[$0] != nil } }
    let needed = min(2, placements.count)
    guard used.count >= needed else { return nil }
    let masked = photos.masked(
      by: try EstimatedMasks(rough, of: photos.ingested.photos, in: folder).masks)
    do {
      let reconstruction = try align(masked, context.part(from: 0.5, to: 0.8))
      let joined = used.filter { $0.contains { reconstruction.poses[$0] != nil } }
      guard joined.count >= needed else { return nil }
      context.notes.record("joinedPlacements", Double(joined.count))
      let final = try masking.run(
        reconstruction, images: photos.images,
        prior: Silhouettes(reconstruction, images: masked.images, options: Self.majority),
        context.part(from: 0.8, to: 1))
      return AlignedPhotos(
        reconstruction: reconstruction,
        masks: try EstimatedMasks(final ?? rough, of: photos.ingested.photos, in: folder))
    } catch is PipelineError {
      return nil
    }
  }

  /// Whatever most of the first masks contain.
  private static var majority: Silhouettes.Options {
    var options = Silhouettes.Options()
    options.minimumShare = 0.5
    return options
  }

  /// Aligns all photos by what the masks leave. Photos without a mask are matched with those that
  /// have one.
  private func align(_ masked: PhotoSet, _ context: StageContext) throws -> Reconstruction {
    var alignment = alignment
    alignment.options.correspondences.matchesUnmaskedPairs = false
    alignment.options.correspondences.secondMotions.isEnabled = false
    var result = try alignment.run(
      photos: masked.ingested.photos, cameras: masked.ingested.cameras, images: masked.images,
      context)
    for index in result.photos.indices { result.photos[index].mask = nil }
    return result
  }

  /// The masks of the photos of one placement; nil if they show no separate object.
  private func masks(
    of placement: [Int], _ map: ImageAlignment.Map, _ images: ImageStore, _ context: StageContext
  ) throws -> ObjectMasking.Result? {
    do {
      let reconstruction = try alignment.reconstruction(
        of: placement, map, images, context.part(from: 0, to: 0.4))
      var masking = masking
      masking.options.isolation.isObjectOnly = map.graph.isObjectOnly
      return try masking.run(reconstruction, images: images, context.part(from: 0.4, to: 1))
    } catch is PipelineError {
      return nil
    }
  }
}
