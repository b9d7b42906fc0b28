import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Rereads the registered photos of an earlier run and checks that they are unchanged.
struct SavedPhotos: Sendable {
  /// Returns photos with the IDs of the run's reconstruction. Throws `SavedRunError.changedPhotos`
  /// if the content of a file has changed.
  func run(_ saved: SavedRun, _ context: StageContext) throws -> IngestedPhotos {
    var options = PhotoIngestion.Options()
    // All of them passed validation in the context of the full set.
    (options.blur.minimumShareOfMedian, options.blur.minimumSharpness) = (0, 0)
    (options.duplicates.maximumBlockDifference, options.maximumPhotos) = (-1, .max)
    options.inspection.usesMasks = false
    let names = saved.record.photos.map(\.name)
    var result = try PhotoIngestion(options)
      .run(files: names.map { saved.photoFolder.appendingPathComponent($0) }, context)
    let hashes = Dictionary(
      zip(result.photos.map(\.name), result.contentHashes.map(\.hexadecimalDigits)),
      uniquingKeysWith: { first, _ in first })
    let changed = saved.record.photos.filter { hashes[$0.name] != $0.contentHash }.map(\.name)
    guard changed.isEmpty, result.photos.map(\.name) == names else {
      throw SavedRunError.changedPhotos(folder: saved.photoFolder.path, names: changed)
    }
    result.processingPixels = saved.record.processingPixels
    for (index, entry) in saved.record.photos.enumerated() {
      result.photos[index].sharpPixels = entry.sharpPixels
    }
    try addMasks(saved, to: &result.photos)
    return result
  }

  /// Restores the masks that the run used.
  private func addMasks(_ saved: SavedRun, to photos: inout [Photo]) throws {
    var changed: [String] = []
    for (index, entry) in saved.record.photos.enumerated() {
      guard var mask = entry.mask else { continue }
      if let file = mask.file {
        let moved = saved.moved(file)
        let bytes = try? ImageCodec.contents(of: moved)
        if bytes.map({ XXHash64.hash($0) }) != mask.contentHash {
          changed.append(moved.lastPathComponent)
        }
        mask.file = moved
      }
      photos[index].mask = mask
    }
    guard changed.isEmpty else {
      throw SavedRunError.changedPhotos(folder: saved.photoFolder.path, names: changed)
    }
  }
}

extension SavedRun {
  /// The current location of a mask of the run: masks inside the folder of photos move with it,
  /// estimated masks with the checkpoint.
  fileprivate func moved(_ file: URL) -> URL {
    let (path, folder) = (file.standardizedFileURL.path, record.photoFolder + "/")
    guard path.hasPrefix(folder) else {
      let isPresent = FileManager.default.fileExists(atPath: path)
      return isPresent ? file : maskFolder.appendingPathComponent(file.lastPathComponent)
    }
    return photoFolder.appendingPathComponent(String(path.dropFirst(folder.count)))
  }

  /// The saved reconstruction with the reread photos.
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
