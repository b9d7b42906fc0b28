import Formats
import Foundation
import Kernels
import SceneModel

/// What stages of an earlier run have found, for one with the same photos and options to go on with.
///
/// `stages/alignment` and `stages/surface` in the checkpoint directory, each sealed with the
/// fingerprint of all that it depends on. The dense stage keeps its own, see `PatchWorkspace`.
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

/// What alignment found, but for the photos themselves.
private struct AlignmentRecord: Codable {
  var cameras: [Camera]
  var cameraOfPhoto: [ID<Camera>]
  var poses: [RigidTransform?]
  var points: [ScenePoint]
  var worldFrame: WorldFrame
  var unregistered: [RefusedPhoto]
  var notes: SavedNotes
}

extension StageStore {
  /// Keeps what alignment found, with the notes that it left.
  func save(_ reconstruction: Reconstruction, _ notes: StageNotes) throws {
    let record = AlignmentRecord(
      cameras: reconstruction.cameras, cameraOfPhoto: reconstruction.photos.map(\.camera),
      poses: reconstruction.poses, points: reconstruction.points,
      worldFrame: reconstruction.worldFrame, unregistered: reconstruction.unregistered,
      notes: SavedNotes(notes))
    try write(record, "alignment", madeFrom: inputs.alignment)
  }

  /// What an earlier run found for the same photos, whose notes are added to `notes`; nil where there
  /// is nothing of use.
  func reconstruction(of photos: [Photo], _ notes: StageNotes) -> Reconstruction? {
    guard let record: AlignmentRecord = read("alignment", madeFrom: inputs.alignment),
      record.cameraOfPhoto.count == photos.count, record.poses.count == photos.count
    else { return nil }
    var photos = photos
    for (index, camera) in record.cameraOfPhoto.enumerated() { photos[index].camera = camera }
    record.notes.replay(to: notes)
    return Reconstruction(
      cameras: record.cameras, photos: photos, poses: record.poses, points: record.points,
      worldFrame: record.worldFrame, unregistered: record.unregistered)
  }
}

// MARK: - Surface

/// Tells that `mesh/surface.ply` is whole and what was noted while it was made.
private struct SurfaceSeal: Codable {
  var contentHash: UInt64
  var notes: SavedNotes
  /// Of the dense stage, which does not run where the surface is taken up.
  var denseNotes: SavedNotes
}

extension StageStore {
  /// Seals the surface in the checkpoint with what it was made from.
  func sealSurface(_ notes: StageNotes, denseNotes: StageNotes) throws {
    guard let hash = surfaceHash() else { return }
    let seal = SurfaceSeal(
      contentHash: hash, notes: SavedNotes(notes), denseNotes: SavedNotes(denseNotes))
    try write(seal, "surface", madeFrom: inputs.surface)
  }

  /// The surface that an earlier run made of the same photos with the same options; nil where there is
  /// none of use. The notes of its stages are added to `notes`.
  func surface(_ notes: StageNotes) -> Mesh? {
    guard let seal: SurfaceSeal = read("surface", madeFrom: inputs.surface),
      seal.contentHash == surfaceHash(), let mesh = try? PLY.readMesh(checkpoint.surface)
    else { return nil }
    seal.denseNotes.sentencesOnly.replay(to: notes)
    seal.notes.replay(to: notes)
    return mesh
  }

  private func surfaceHash() -> UInt64? {
    (try? Data(contentsOf: checkpoint.surface, options: .alwaysMapped))?
      .withUnsafeBytes { XXHash64.hash($0) }
  }
}

// MARK: - Notes

/// A stage's notes as they are kept.
private struct SavedNotes: Codable {
  var counts: [String: Double]
  var warnings: [String]
  var details: [String]

  init(_ notes: StageNotes) {
    (counts, warnings, details) = (notes.counts, notes.warnings, notes.details)
  }

  /// Without the figures, which are another stage's.
  var sentencesOnly: SavedNotes {
    var result = self
    result.counts = [:]
    return result
  }

  func replay(to notes: StageNotes) {
    for (name, value) in counts { notes.record(name, value) }
    warnings.forEach(notes.warn)
    details.forEach(notes.log)
  }
}
