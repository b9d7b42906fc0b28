import Foundation
import Kernels
import SceneModel

/// What a surface was made of: the content of `mesh/surface.json`, which tells whether more models can
/// be made of the surface.
package struct SurfaceRecord: Codable, Equatable, Sendable {
  package struct PhotoFile: Codable, Equatable, Sendable {
    package var name: String
    /// Of the file's bytes.
    package var contentHash: String
    /// What the run took the object from; nil where it used no mask.
    package var mask: PhotoMask?
  }

  /// Changes when a program that knows the one can't use the other.
  package static let currentFormat = 1

  package var format = Self.currentFormat
  /// Absolute.
  package var photoFolder: String
  /// Those with a pose, in the order of `sparse/images.txt`.
  package var photos: [PhotoFile]
  /// Pixels of a view in the dense stage.
  package var viewPixels: Int
  /// Most pixels of a photo that stages work on.
  package var processingPixels: Int
  package var worldFrame: WorldFrame
  /// Of the cameras and poses in `sparse/`.
  package var sparseHash: String

  init(
    _ reconstruction: Reconstruction, of ingested: IngestedPhotos, in folder: URL, viewPixels: Int,
    sparseHash: String
  ) {
    photoFolder = folder.standardizedFileURL.path
    photos = reconstruction.registered.map { id in
      PhotoFile(
        name: ingested.photos[id.index].name,
        contentHash: Self.text(ingested.contentHashes[id.index]),
        mask: ingested.photos[id.index].mask)
    }
    self.viewPixels = viewPixels
    processingPixels = ingested.processingPixels
    worldFrame = reconstruction.worldFrame
    self.sparseHash = sparseHash
  }

  /// A hash as JSON keeps it: numbers of 64 bits are rounded by some readers.
  static func text(_ hash: UInt64) -> String {
    let digits = String(hash, radix: 16)
    return String(repeating: "0", count: 16 - digits.count) + digits
  }

  func encoded() throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return try encoder.encode(self)
  }
}
