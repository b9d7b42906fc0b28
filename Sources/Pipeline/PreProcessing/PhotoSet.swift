import SceneModel

/// The usable photos of a run and the store that decodes them.
struct PhotoSet: Sendable {
  let ingested: IngestedPhotos
  /// Gravity and depth by sample ID.
  let readings: [Int: SensorReading]
  let images: ImageStore
  private let byteBudget: Int

  /// `readings` replace those of files next to the photos. `byteBudget` bounds the decoded photos
  /// that are kept.
  init(_ ingested: IngestedPhotos, readings: [Int: SensorReading], byteBudget: Int) {
    self.ingested = ingested
    self.readings = ingested.readings.merging(readings) { _, given in given }
    self.byteBudget = byteBudget
    images = ImageStore(
      photos: ingested.photos, byteBudget: byteBudget,
      processingPixels: ingested.processingPixels, contentHashes: ingested.contentHashes)
  }

  /// The same photos with masks, by photo ID.
  func masked(by masks: [PhotoMask?]) -> PhotoSet {
    var masked = ingested
    for index in masked.photos.indices { masked.photos[index].mask = masks[index] }
    return PhotoSet(masked, readings: readings, byteBudget: byteBudget)
  }

  /// The same photos, none of them decoded.
  var emptied: PhotoSet { PhotoSet(ingested, readings: readings, byteBudget: byteBudget) }
}
