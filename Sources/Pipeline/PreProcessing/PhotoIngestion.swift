import Foundation
import Kernels
import SceneModel

/// Validates the files of a folder: the first stage of a run.
///
/// Every file is read and decoded once. File names are irrelevant, except for masks and sensor
/// readings: see `MaskFiles` and `SensorFiles`. Unusable files are rejected with a reason, and the
/// run continues with the rest. If masks are disabled, mask files are still not treated as photos.
package struct PhotoIngestion: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    package var inspection = PhotoInspection.Options()
    package var duplicates = DuplicateDetection.Options()
    package var blur = BlurDetection.Options()
    package var focalLength = FocalLengthEstimation.Options()
    /// Maximum number of photos; further ones are rejected. Chosen: `Machine.limits` sets that of
    /// the machine.
    package var maximumPhotos = 1000
    /// Maximum number of bytes used to process one photo. Chosen: `Machine.limits` sets that of the
    /// machine.
    package var memoryBudget = 1 << 30
    /// Bytes that a stage needs per pixel of a photo; the scale space of feature detection needs
    /// the most. Chosen.
    package var bytesPerPixel = 64
    /// A folder of masks that replaces the one inside the folder of photos.
    package var maskFolder: URL?

    package init() {}
  }

  package var options: Options
  /// Inspections that other processes have made.
  var units: InspectionUnits?

  package init(_ options: Options = Options()) { self.options = options }

  /// Validates the files of a folder. Throws only if the folder can't be listed or on cancellation.
  package func run(folder: URL, _ context: StageContext) throws -> IngestedPhotos {
    try run(MaskFiles(folder: folder, maskFolder: options.maskFolder), context)
  }

  /// Validates the given files, masks included, in their order.
  package func run(files: [URL], _ context: StageContext) throws -> IngestedPhotos {
    try run(MaskFiles(files: files, maskFiles: []), context)
  }

  private func run(_ masks: MaskFiles, _ context: StageContext) throws -> IngestedPhotos {
    let sensors = SensorFiles(masks.photos)
    let files = sensors.photos
    var (candidates, rejected) = try inspect(files, masks, context.part(from: 0, to: 0.95))
    // Blank ones were decoded, too.
    let decoded = candidates.count + rejected.count { $0.fault == .blank }
    context.notes.record("decodedPhotos", Double(decoded))
    let originals = try DuplicateDetection(options.duplicates)
      .run(candidates, context.part(from: 0.95, to: 1))
    let names = candidates.map(\.url.lastPathComponent)
    rejected += originals.indices.compactMap { index in
      originals[index].map {
        rejection(candidates[index], .duplicate, "it shows the same picture as \(names[$0])")
      }
    }
    candidates = zip(candidates, originals).filter { $0.1 == nil }.map(\.0)
    var detail = BlurDetection(options.blur).run(candidates.map(\.sharpness))
    rejected += zip(candidates, detail).filter { $0.1 == .unusable }.map {
      rejection($0.0, .blurred, "it is blurred; take it again with a steady, focused camera")
    }
    candidates = zip(candidates, detail).filter { $0.1 != .unusable }.map(\.0)
    detail.removeAll { $0 == .unusable }
    resolveMaskOrientations(&candidates)
    var result = assemble(candidates, rejected.sorted { $0.sampleID < $1.sampleID }, files)
    for (index, detail) in detail.enumerated() {
      if case .blurred(let pixels) = detail { result.photos[index].sharpPixels = pixels }
    }
    if options.inspection.usesMasks {
      result.rejectedMasks += masks.masksWithoutPhoto.map {
        RejectedMask(
          name: $0.lastPathComponent,
          reason: "\($0.lastPathComponent) is a mask without a photo; it is not used.")
      }
    }
    result.readings = readings(candidates, sensors, context.notes)
    report(result, candidates, context.notes)
    return result
  }

  /// The readings of the photos by sample ID: from files next to them, else from the photos.
  private func readings(
    _ photos: [InspectedPhoto], _ sensors: SensorFiles, _ notes: StageNotes
  ) -> [Int: SensorReading] {
    var readings: [Int: SensorReading] = [:]
    for photo in photos {
      var problems: [String] = []
      let reading = sensors.reading(
        nextTo: photo.url, orientation: photo.metadata.sensorOrientation, inside: photo.reading,
        &problems)
      if reading != SensorReading() { readings[photo.sampleID] = reading }
      problems.forEach(notes.warn)
    }
    let relative = photos.count { $0.hasRelativeDepth && readings[$0.sampleID]?.depth == nil }
    if relative > 0 {
      notes.log(
        "The depth maps in \(relative) of \(photos.count) photos have no scale; they are not used.")
    }
    return readings
  }

  /// Reads files in blocks, so that files beyond the maximum are not even opened.
  private func inspect(
    _ files: [URL], _ masks: MaskFiles, _ context: StageContext
  ) throws -> ([InspectedPhoto], [RejectedPhoto]) {
    let inspection = FileInspection(files, masks, options.inspection)
    var (accepted, rejected) = ([InspectedPhoto](), [RejectedPhoto]())
    for range in InspectionBlock.ranges(ofCount: files.count) {
      guard accepted.count < options.maximumPhotos else {
        rejected += range.map { tooMany(files[$0], $0) }
        continue
      }
      let control = context.control.part(
        from: Double(range.lowerBound) / Double(files.count),
        to: Double(range.upperBound) / Double(files.count))
      let block = try units?.find(range) ?? inspection.run(range, control)
      for result in block.results {
        switch result {
        case .success(let photo) where accepted.count >= options.maximumPhotos:
          rejected.append(tooMany(photo.url, photo.sampleID))
        case .success(let photo): accepted.append(photo)
        case .failure(let rejection): rejected.append(rejection.photo)
        }
      }
    }
    return (accepted, rejected)
  }

  /// Inspects a block of the files of a folder for other processes.
  func inspect(
    _ block: Block, in folder: URL, for units: InspectionUnits, _ context: StageContext
  ) throws {
    let masks = try MaskFiles(folder: folder, maskFolder: options.maskFolder)
    let inspection = FileInspection(
      SensorFiles(masks.photos).photos, masks, options.inspection)
    let ranges = InspectionBlock.ranges(ofCount: inspection.files.count)
    let own = ranges[block.range(of: ranges.count)]
    for (number, range) in own.enumerated() {
      try units.block(range) {
        try inspection.run(range, context.part(number, of: own.count).control)
      }
    }
  }

  private func tooMany(_ file: URL, _ sampleID: Int) -> RejectedPhoto {
    RejectedPhoto(
      sampleID: sampleID, name: file.lastPathComponent, fault: .tooMany,
      end: "a run accepts \(options.maximumPhotos) photos; leave some out")
  }

  private func rejection(
    _ photo: InspectedPhoto, _ fault: RejectedPhoto.Fault, _ end: String
  ) -> RejectedPhoto {
    RejectedPhoto(
      sampleID: photo.sampleID, name: photo.url.lastPathComponent, fault: fault, end: end)
  }

  /// Resolves the orientation of masks for photos whose stored and upright sizes are equal: the
  /// majority of the other masks decides, since one program wrote them all.
  private func resolveMaskOrientations(_ photos: inout [InspectedPhoto]) {
    let orientationVotes = photos.compactMap { $0.mask?.isAsStored }
    guard orientationVotes.count(where: { $0 }) > orientationVotes.count(where: { !$0 }) else {
      return
    }
    for index in photos.indices {
      if let other = photos[index].mask?.otherOrientation {
        photos[index].mask?.mask.orientation = other
      }
    }
  }

  private func assemble(
    _ accepted: [InspectedPhoto], _ rejected: [RejectedPhoto], _ files: [URL]
  ) -> IngestedPhotos {
    let (cameras, cameraIDs) = CameraGrouping(FocalLengthEstimation(options.focalLength))
      .run(accepted)
    let photos = zip(accepted, cameraIDs).enumerated().map { index, pair in
      let (photo, camera) = pair
      return Photo(
        id: ID(index), sampleID: photo.sampleID, name: photo.url.lastPathComponent, url: photo.url,
        width: photo.width, height: photo.height, orientation: photo.metadata.orientation,
        camera: camera, position: photo.metadata.position, mask: photo.mask?.mask)
    }
    let processingPixels = max(
      options.inspection.minimumPixels, options.memoryBudget / max(1, options.bytesPerPixel))
    return IngestedPhotos(
      photos: photos, cameras: cameras, rejected: rejected, files: files,
      rejectedMasks: accepted.compactMap(\.rejectedMask),
      contentHashes: accepted.map(\.contentHash),
      processingPixels: processingPixels,
      isDownsampled: photos.contains { $0.width * $0.height > processingPixels })
  }

  private func report(
    _ result: IngestedPhotos, _ accepted: [InspectedPhoto], _ notes: StageNotes
  ) {
    notes.record("files", Double(result.files.count))
    notes.record("photos", Double(result.photos.count))
    notes.record("refused", Double(result.rejected.count))
    notes.record("cameras", Double(result.cameras.count))
    let masked = result.photos.compactMap(\.mask)
    notes.record("masks", Double(masked.count))
    notes.record("refusedMasks", Double(result.rejectedMasks.count))
    if !masked.isEmpty {
      let coverage = masked.reduce(0) { $0 + $1.coverage } / Double(masked.count)
      notes.record("meanMaskCoverage", coverage)
      notes.log("\(masked.count) of \(result.photos.count) photos have a mask.")
    }
    result.rejectedMasks.forEach { notes.warn($0.reason) }
    notes.record("megapixels", PhotoTotals(result.photos).megapixels)
    let blurred = result.photos.filter { $0.sharpPixels != nil }
    notes.record("blurred", Double(blurred.count))
    for photo in blurred {
      notes.log("\(photo.name) is blurred; where other photos show the same, it counts less.")
    }
    if let median = accepted.map(\.sharpness.atFullSize).upperMedian {
      notes.record("medianSharpness", median)
    }
  }
}
