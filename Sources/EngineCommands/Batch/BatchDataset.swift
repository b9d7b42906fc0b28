import Formats
import Foundation
import Kernels
import Pipeline

/// A folder with the photos of one object, as part of a batch.
struct BatchDataset: Equatable, Sendable {
  /// The folder's name.
  let name: String
  /// The folder of the photos: the dataset's folder, or `images/` in it.
  let photos: URL
  /// The folder of masks next to `images/`; nil if masks are in the photos' folder.
  let masks: URL?
  /// Distances measured on the object: a file for `--measurements`.
  let measurements: URL?

  /// The folders in `folder`, in natural order, except hidden ones and `models`.
  static func all(in folder: URL, except models: URL) throws -> [BatchDataset] {
    let excluded = models.standardizedFileURL.resolvingSymlinksInPath().path
    return try FileManager.default.contentsOfDirectory(atPath: folder.path)
      .filter { !$0.hasPrefix(".") }
      .map { folder.appendingPathComponent($0, isDirectory: true) }
      .filter {
        $0.isExistingFolder && $0.standardizedFileURL.resolvingSymlinksInPath().path != excluded
      }
      .sorted { a, b in
        let (a, b) = (a.lastPathComponent, b.lastPathComponent)
        let order = a.compare(b, options: [.numeric, .caseInsensitive])
        return order == .orderedSame ? a < b : order == .orderedAscending
      }
      .map(BatchDataset.init)
  }

  private init(_ folder: URL) {
    name = folder.lastPathComponent
    let images = folder.appendingPathComponent("images", isDirectory: true)
    let hasOwn = Self.files(in: folder).contains { Self.isImage($0) }
    let hasImages = !hasOwn && images.isExistingFolder
    photos = hasImages ? images : folder
    masks =
      hasImages
      ? PhotoFolder.maskFolderNames.map { folder.appendingPathComponent($0, isDirectory: true) }
        .first(where: \.isExistingFolder) : nil
    let file = folder.appendingPathComponent("measurements.json", isDirectory: false)
    measurements = FileManager.default.fileExists(atPath: file.path) ? file : nil
  }

  /// Options of `reconstruct` for the files of this dataset.
  var arguments: [String] {
    (masks.map { ["--masks", $0.path] } ?? [])
      + (measurements.map { ["--measurements", $0.path] } ?? [])
  }

  /// Number of files that may be photos.
  var photoCount: Int { Self.files(in: photos).count }

  /// A hash of the photos, masks, measurements and `options`: see `InputFingerprint`.
  func fingerprint(options: [String]) -> String {
    let folders =
      [photos] + PhotoFolder.maskFolderNames.map { photos.appendingPathComponent($0) }
      + (masks.map { [$0] } ?? [])
    return InputFingerprint.text(
      of: folders.flatMap(Self.files) + (measurements.map { [$0] } ?? []), options: options)
  }

  private static func files(in folder: URL) -> [URL] {
    (try? PhotoFolder.files(in: folder)) ?? []
  }

  /// Whether the file name is that of an image, to find the folder of photos. Ingestion judges
  /// files by their content.
  private static func isImage(_ file: URL) -> Bool {
    [
      "jpg", "jpeg", "mpo", "png", "tif", "tiff", "bmp", "webp", "heic", "heif", "hif", "avif",
      "exr",
      "dng", "cr2", "cr3", "crw", "nef", "nrw", "arw", "srf", "sr2", "raf", "orf", "rw2", "pef",
      "srw", "x3f", "iiq", "3fr", "erf", "kdc", "dcr", "mrw", "mos", "rwl",
    ]
    .contains(file.pathExtension.lowercased())
  }
}
