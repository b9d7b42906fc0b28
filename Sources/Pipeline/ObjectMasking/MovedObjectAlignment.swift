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
    if let placements = map.findings?.placements, placements.count > 1 {
      let notes = StageNotes()
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
  /// than two placements, or fewer photos than the map.
  private func join(
    _ placements: [[Int]], _ map: ImageAlignment.Map, _ photos: PhotoSet, folder: URL,
    _ context: StageContext
  ) throws -> AlignedPhotos? {
    var masked = ObjectMasking.Result(photoCount: photos.ingested.photos.count)
    for (number, placement) in placements.enumerated() {
      let share = 0.6 / Double(placements.count)
      let control = context.part(
        from: share * Double(number), to: share * Double(number + 1)
      ).control
      if let found = try masks(
        of: placement, map, photos.images, StageContext(control: control, notes: StageNotes()))
      {
        masked.add(found)
      }
    }
    let used = placements.filter { $0.contains { masked.masks[$0] != nil } }
    guard used.count > 1 else { return nil }
    let masks = try EstimatedMasks(masked, of: photos.ingested.photos, in: folder)
    do {
      let reconstruction = try align(photos, by: masks, folder, context.part(from: 0.6, to: 1))
      let joined = used.filter { $0.contains { reconstruction.poses[$0] != nil } }
      guard joined.count > 1 else { return nil }
      context.notes.record("joinedPlacements", Double(joined.count))
      return AlignedPhotos(reconstruction: reconstruction, masks: masks)
    } catch is PipelineError {
      return nil
    }
  }

  /// Aligns all photos by what the masks leave; photos without a mask are not aligned.
  private func align(
    _ photos: PhotoSet, by masks: EstimatedMasks, _ folder: URL, _ context: StageContext
  ) throws -> Reconstruction {
    let hidden = try masks.hidingUnmasked(in: folder)
    defer { hidden.file.map { try? FileManager.default.removeItem(at: $0) } }
    let set = photos.masked(by: masks.masks.map { $0 ?? hidden })
    var result = try alignment.run(
      photos: set.ingested.photos, cameras: set.ingested.cameras, images: set.images, context)
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
      return try masking.run(reconstruction, images: images, context.part(from: 0.4, to: 1))
    } catch is PipelineError {
      return nil
    }
  }
}
