import Foundation
import Kernels
import SceneModel

// How each kind of source provides photos, cameras and a surface.

extension RunSource {
  /// Gravity and depth by sample ID, as passed by the caller.
  var readings: [Int: SensorReading] {
    if case .photos(_, let readings) = self { readings } else { [:] }
  }

  /// Reads and validates the photos, unless another process did.
  func ingest(
    _ configuration: PipelineConfiguration, _ units: UnitStore?, _ context: StageContext
  ) throws -> IngestedPhotos {
    switch self {
    case .photos(let folder, _):
      guard let units else {
        return try PhotoIngestion(configuration.ingestion).run(folder: folder, context)
      }
      let key = try IngestedRecord.key(of: folder, configuration.ingestion)
      let notes = StageNotes(meter: context.notes.meter)
      let record = try units.value(.photos, madeFrom: key) {
        var ingestion = PhotoIngestion(configuration.ingestion)
        ingestion.units = InspectionUnits(units, folderKey: key)
        return IngestedRecord(
          try ingestion.run(folder: folder, StageContext(control: context.control, notes: notes)),
          notes)
      }
      record.replayNotes(to: context.notes)
      return record.ingested
    case .photosWithCameras(let folder, _):
      return try PhotoIngestion(configuration.ingestion).run(folder: folder, context)
    case .savedRun(let saved): return try SavedPhotos().run(saved, context)
    }
  }

  /// Inspects a block of the files for the processes that work on the same run.
  func inspect(
    _ block: Block, _ configuration: PipelineConfiguration, _ units: UnitStore,
    _ context: StageContext
  ) throws {
    let (options, folder) = (configuration.ingestion, photoFolder)
    let key = try IngestedRecord.key(of: folder, options)
    try PhotoIngestion(options)
      .inspect(block, in: folder, for: InspectionUnits(units, folderKey: key), context)
  }

  /// Cameras, poses and sparse points: estimated, given or saved.
  func cameras(
    of photos: PhotoSet, _ configuration: PipelineConfiguration, _ cache: StageCache,
    _ recorder: RunRecorder
  ) throws -> AlignedPhotos {
    switch self {
    case .photos:
      return try recorder.run(.imageAlignment, images: photos.images) { context in
        try cache.sealedAlignment(of: photos, configuration, context.notes) {
          try Self.align(
            photos, configuration, cache.units, maskFolder: cache.maskFolder(), context)
        }
      }
    case .photosWithCameras(_, let known):
      let (result, missing) = try recorder.run(.imageAlignment, images: photos.images) {
        try Self.assign(known, to: photos, $0)
      }
      recorder.record(missing: missing)
      return AlignedPhotos(reconstruction: result)
    case .savedRun(let saved):
      return AlignedPhotos(reconstruction: saved.reconstruction(of: photos.ingested))
    }
  }

  /// Structure from motion.
  private static func align(
    _ photos: PhotoSet, _ configuration: PipelineConfiguration, _ units: UnitStore?,
    maskFolder: URL, _ context: StageContext
  ) throws -> AlignedPhotos {
    var alignment = ImageAlignment(configuration.alignmentOptions(for: photos.images))
    alignment.units = units
    alignment.options.worldAlignment.readings = photos.readings
    guard configuration.findsObject(in: photos.images) else {
      return AlignedPhotos(
        reconstruction: try MaskedAlignment(alignment)
          .run(photos.ingested, images: photos.images, context))
    }
    let aligned = Result {
      try MovedObjectAlignment(
        options: configuration.movedObjects, alignment: alignment,
        masking: ObjectMasking(options: configuration.objectMasking)
      ).run(photos, folder: maskFolder, context)
    }
    // The masks of placements that could not be joined have been written.
    if (try? aligned.get())?.masks == nil {
      try EstimatedMasks.removeFiles(of: photos.ingested.photos, in: maskFolder)
    }
    return try aligned.get()
  }

  /// Assigns given cameras to the photos, and triangulates sparse points if none were given. Also
  /// returns the names of cameras without a photo.
  private static func assign(
    _ known: KnownCameras, to photos: PhotoSet, _ context: StageContext
  ) throws -> (Reconstruction, missing: [String]) {
    let assigned = try CameraAssignment()
      .run(known, to: photos.ingested, context.part(from: 0, to: 0.01))
    let result = try KnownPoints()
      .run(assigned.reconstruction, images: photos.images, context.part(from: 0.01, to: 1))
    return (result, assigned.missing)
  }
}

extension SavedRun {
  /// The saved surface; warns if it was made from views of lower resolution.
  func surface(_ viewPixels: Int, _ recorder: RunRecorder) -> Mesh {
    if record.viewPixels < viewPixels {
      recorder.warn(
        "The surface was made from views of \(megapixelText(record.viewPixels)), not "
          + "\(megapixelText(viewPixels)) as at this level, and has no more detail. Repeat the run "
          + "at this level for more.")
    }
    return surface
  }
}

/// A number of pixels as megapixels, for instance `0.18 MP`.
func megapixelText(_ pixels: Int) -> String { "\(Double(pixels / 10_000) / 100) MP" }
