import Foundation
import Kernels
import SceneModel

/// Reads the photos of an earlier run again: those that have a pose, as they were.
struct SavedPhotos: Sendable {
  /// Photo ids are those of the run's reconstruction. Throws `SavedRunError.changedPhotos` where a
  /// file's content is another one.
  func run(_ saved: SavedRun, _ context: StageContext) throws -> IngestedPhotos {
    var options = PhotoIngestion.Options()
    // All were accepted once, among others that they were compared with.
    (options.blur.minimumShareOfMedian, options.blur.hopeless) = (0, 0)
    (options.duplicates.maximumBlockDifference, options.maximumPhotos) = (-1, .max)
    let names = saved.record.photos.map(\.name)
    var result = try PhotoIngestion(options)
      .run(files: names.map { saved.photoFolder.appendingPathComponent($0) }, context)
    let hashes = Dictionary(
      zip(result.photos.map(\.name), result.contentHashes.map(SurfaceRecord.text)),
      uniquingKeysWith: { first, _ in first })
    let changed = saved.record.photos.filter { hashes[$0.name] != $0.contentHash }.map(\.name)
    guard changed.isEmpty, result.photos.map(\.name) == names else {
      throw SavedRunError.changedPhotos(folder: saved.photoFolder.path, names: changed)
    }
    result.processingPixels = saved.record.processingPixels
    return result
  }
}

extension SavedRun {
  /// The reconstruction of the photos that were read again.
  func reconstruction(of photos: IngestedPhotos) -> Reconstruction {
    var result = reconstruction
    result.worldFrame = record.worldFrame
    for index in result.photos.indices {
      let camera = result.photos[index].camera
      result.photos[index] = photos.photos[index]
      result.photos[index].camera = camera
    }
    return result
  }
}
