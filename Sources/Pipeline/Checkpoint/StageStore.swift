import Formats
import Foundation
import Kernels
import SceneModel

/// The results of finished stages, which a later run with the same photos and options reuses.
///
/// Stored as `stages/{alignment,masks,surface}` in the checkpoint directory, each sealed with the
/// fingerprint of everything that it depends on. For the results of the dense stage, see
/// `PatchWorkspace`.
struct StageStore {
  let checkpoint: Checkpoint
  let inputs: RunInputs

  private func url(_ name: String) -> URL {
    checkpoint.directory.appendingPathComponent("stages/\(name)")
  }

  private func write(_ value: some Encodable, _ name: String, madeFrom inputs: UInt64) throws {
    let url = url(name)
    try FileManager.default.createDirectory(
      at: url.deletingLastPathComponent(), withIntermediateDirectories: true)
    try SealedFile.write(try JSONEncoder().encode(value), madeFrom: inputs, to: url)
  }

  private func read<Value: Decodable>(_ name: String, madeFrom inputs: UInt64) -> Value? {
    SealedFile.read(url(name), madeFrom: inputs)
      .flatMap { try? JSONDecoder().decode(Value.self, from: $0) }
  }
}

// MARK: - Alignment

/// The result of alignment without the photos.
private struct AlignmentRecord: Codable {
  /// The masks of an object that was moved; nil if it was not.
  var masks: EstimatedMasks?
  var cameras: [Camera]
  var cameraOfPhoto: [ID<Camera>]
  var poses: [RigidTransform?]
  var points: PackedPoints
  var worldFrame: WorldFrame
  var unregistered: [RejectedPhoto]
  var notes: SavedNotes
}

extension StageStore {
  /// Saves the result of alignment with its notes.
  func save(_ aligned: AlignedPhotos, _ notes: StageNotes) throws {
    let reconstruction = aligned.reconstruction
    let record = AlignmentRecord(
      masks: aligned.masks, cameras: reconstruction.cameras,
      cameraOfPhoto: reconstruction.photos.map(\.camera),
      poses: reconstruction.poses, points: PackedPoints(reconstruction.points),
      worldFrame: reconstruction.worldFrame, unregistered: reconstruction.unregistered,
      notes: SavedNotes(notes))
    try write(record, "alignment", madeFrom: inputs.alignment)
  }

  /// The alignment of the same photos by an earlier run; nil if there is none that can be reused.
  /// Its notes are added to `notes`.
  func alignment(of photos: [Photo], _ notes: StageNotes) -> AlignedPhotos? {
    guard let record: AlignmentRecord = read("alignment", madeFrom: inputs.alignment),
      record.cameraOfPhoto.count == photos.count, record.poses.count == photos.count,
      record.masks?.areIntact ?? true, let points = record.points.points
    else { return nil }
    var photos = photos
    for (index, camera) in record.cameraOfPhoto.enumerated() { photos[index].camera = camera }
    record.notes.replay(to: notes)
    return AlignedPhotos(
      reconstruction: Reconstruction(
        cameras: record.cameras, photos: photos, poses: record.poses, points: points,
        worldFrame: record.worldFrame, unregistered: record.unregistered),
      masks: record.masks)
  }
}

// MARK: - Masks

/// Estimated masks with the notes of the stage that made them.
private struct MaskRecord: Codable {
  var masks: EstimatedMasks
  var notes: SavedNotes
}

extension StageStore {
  /// Saves estimated masks with the notes of their stage.
  func save(_ masks: EstimatedMasks, _ notes: StageNotes) throws {
    try write(
      MaskRecord(masks: masks, notes: SavedNotes(notes)), "masks", madeFrom: inputs.masks)
  }

  /// The masks that an earlier run estimated for the same photos; nil if there are none that can be
  /// reused. The notes of their stage are added to `notes`.
  func masks(_ notes: StageNotes) -> EstimatedMasks? {
    guard let record: MaskRecord = read("masks", madeFrom: inputs.masks), record.masks.areIntact
    else { return nil }
    record.notes.replay(to: notes)
    return record.masks
  }
}

// MARK: - Surface

/// Certifies that `mesh/surface.ply` is complete, with the notes of the stages that made it.
private struct SurfaceSeal: Codable {
  var contentHash: UInt64
  var notes: SavedNotes
  /// The notes of the dense stage, which does not run if the surface is reused.
  var denseNotes: SavedNotes
}

extension StageStore {
  /// Seals the surface in the checkpoint with the fingerprint of its inputs.
  func sealSurface(_ notes: StageNotes, denseNotes: StageNotes) throws {
    guard let hash = surfaceHash() else { return }
    let seal = SurfaceSeal(
      contentHash: hash, notes: SavedNotes(notes), denseNotes: SavedNotes(denseNotes))
    try write(seal, "surface", madeFrom: inputs.surface)
  }

  /// The surface that an earlier run made from the same photos with the same options; nil if there
  /// is none that can be reused. The notes of its stages are added to `notes`.
  func surface(_ notes: StageNotes) -> Mesh? {
    guard let seal: SurfaceSeal = read("surface", madeFrom: inputs.surface),
      seal.contentHash == surfaceHash(), let mesh = try? PLY.readMesh(checkpoint.surface)
    else { return nil }
    seal.denseNotes.sentencesOnly.replay(to: notes)
    seal.notes.replay(to: notes)
    return mesh
  }

  /// The hash of the surface in the checkpoint; nil if there is none.
  private func surfaceHash() -> UInt64? {
    (try? Data(contentsOf: checkpoint.surface, options: .alwaysMapped))?
      .withUnsafeBytes { XXHash64.hash($0) }
  }
}
