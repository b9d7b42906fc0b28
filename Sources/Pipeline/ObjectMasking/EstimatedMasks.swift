import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel

/// Estimated masks as PNG files, which later stages use like masks that were given.
struct EstimatedMasks: Codable, Sendable {
  /// By photo ID; nil for photos without a usable mask.
  var masks: [PhotoMask?]
  /// Agreement of each mask with those of all photos, 0…1.
  var agreement: [Double?]
  /// What the object stands on; nil if nothing was found.
  var support: SupportPlane?
  /// Coarse points of the surroundings.
  var surroundings: PointCloud

  /// Writes the masks to a folder, with the names of `MaskFiles.names(forMasksOf:)`; without a
  /// result there are none. Throws `OutputError`.
  init(
    _ result: ObjectMasking.Result?, of photos: [Photo], in folder: URL, _ control: KernelControl
  ) throws {
    masks = Array(repeating: nil, count: photos.count)
    agreement = result?.agreement ?? Array(repeating: nil, count: photos.count)
    support = result?.support
    surroundings = result?.points.surroundings ?? PointCloud()
    try Self.removeFiles(of: photos, in: folder)
    guard let result else { return }
    try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    let files = Self.files(of: photos, in: folder)
    masks = try control.withoutProgress.parallelMap(photos.count) { [images = result.masks] index in
      try images[index].map { image in
        let bytes = try ImageCodec.encodePNG(image)
        try AtomicFile.write(Data(bytes), to: files[index])
        let marked = image.pixels.count { $0 != 0 }
        return PhotoMask(
          file: files[index], orientation: 1, contentHash: XXHash64.hash(bytes),
          coverage: Double(marked) / Double(image.pixels.count))
      }
    }
  }

  /// Removes what an earlier attempt wrote for these photos: it must not pass for a mask.
  static func removeFiles(of photos: [Photo], in folder: URL) throws {
    for file in files(of: photos, in: folder)
    where FileManager.default.fileExists(atPath: file.path) {
      try FileManager.default.removeItem(at: file)
    }
  }

  /// The file of each photo's mask.
  private static func files(of photos: [Photo], in folder: URL) -> [URL] {
    MaskFiles.names(forMasksOf: photos.map(\.name)).map(folder.appendingPathComponent)
  }

  /// Whether all files are present and unchanged.
  var areIntact: Bool { masks.areIntact }

  /// Whether there is no mask.
  var isEmpty: Bool { masks.allSatisfy { $0 == nil } }
}

extension [PhotoMask?] {
  /// Whether all files of masks are present and unchanged.
  var areIntact: Bool {
    allSatisfy { mask in
      guard let mask, let file = mask.file else { return true }
      return FileManager.default.contents(atPath: file.path).map { XXHash64.hash([UInt8]($0)) }
        == mask.contentHash
    }
  }
}
