import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Writes the masks in use to a folder, to be inspected, corrected and used as given masks.
struct MaskOutput {
  let folder: URL

  /// Writes the mask of each photo that has one at the photo's size, with the names of
  /// `MaskFiles.names(forMasksOf:)`. Throws `OutputError`.
  func write(_ photos: PhotoSet, _ context: StageContext) throws {
    try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    let names = MaskFiles.names(forMasksOf: photos.ingested.photos.map(\.name))
    if !photos.images.hasMasks {
      context.notes.warn(
        "No masks were written to \(folder.relativePath): the photos have none, and show no "
          + "separate object.")
    }
    _ = try context.control.parallelMap(photos.ingested.photos.count) { [folder] index in
      let photo = photos.ingested.photos[index]
      guard let mask = try photos.images.mask(photo.id) else { return }
      let bytes = try ImageCodec.encodePNG(mask.marking { $0 >= 128 })
      try AtomicFile.write(
        Data(bytes), to: folder.appendingPathComponent(names[index]))
    }
  }
}
