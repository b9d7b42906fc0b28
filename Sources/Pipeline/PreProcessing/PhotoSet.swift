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

  /// The photos of a set without masks, with masks by photo ID. The two share decoded images.
  private init(_ other: PhotoSet, masks: [PhotoMask?]) {
    var ingested = other.ingested
    for index in ingested.photos.indices { ingested.photos[index].mask = masks[index] }
    self.ingested = ingested
    (readings, byteBudget) = (other.readings, other.byteBudget)
    images = ImageStore(
      masked: ingested.photos, contentHashes: ingested.contentHashes, sharing: other.images)
  }

  /// The same photos with masks, by photo ID; this set has none.
  func masked(by masks: [PhotoMask?]) -> PhotoSet { PhotoSet(self, masks: masks) }

  /// The same photos, none of them decoded.
  var emptied: PhotoSet { PhotoSet(ingested, readings: readings, byteBudget: byteBudget) }
}
