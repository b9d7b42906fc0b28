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
  init(_ result: ObjectMasking.Result?, of photos: [Photo], in folder: URL) throws {
    masks = Array(repeating: nil, count: photos.count)
    agreement = result?.agreement ?? Array(repeating: nil, count: photos.count)
    support = result?.support
    surroundings = result?.points.surroundings ?? PointCloud()
    guard let result else { return }
    try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    let names = MaskFiles.names(forMasksOf: photos.map(\.name))
    for (index, image) in result.masks.enumerated() {
      let file = folder.appendingPathComponent(names[index])
      guard let image else {
        // What an earlier attempt wrote must not pass for a mask.
        if FileManager.default.fileExists(atPath: file.path) {
          try FileManager.default.removeItem(at: file)
        }
        continue
      }
      let bytes = try ImageCodec.encodePNG(image)
      try AtomicFile.write(Data(bytes), to: file)
      let marked = image.pixels.count { $0 != 0 }
      masks[index] = PhotoMask(
        file: file, orientation: 1, contentHash: XXHash64.hash(bytes),
        coverage: Double(marked) / Double(image.pixels.count))
    }
  }

  /// Whether all files are present and unchanged.
  var areIntact: Bool {
    masks.allSatisfy { mask in
      guard let mask, let file = mask.file else { return true }
      return FileManager.default.contents(atPath: file.path).map { XXHash64.hash([UInt8]($0)) }
        == mask.contentHash
    }
  }

  /// Whether there is no mask.
  var isEmpty: Bool { masks.allSatisfy { $0 == nil } }
}
