import Foundation
import Kernels
import SceneModel

/// The inputs of a surface: the content of `mesh/surface.json`, which determines whether further
/// models can be made from the surface.
package struct SurfaceRecord: Codable, Equatable, Sendable {
  /// A registered photo.
  package struct PhotoFile: Codable, Equatable, Sendable {
    package var name: String
    /// XXH64 of the file's bytes, in hexadecimal.
    package var contentHash: String
    /// The mask that the run used; nil if it used none.
    package var mask: PhotoMask?
    /// See `Photo.sharpPixels`.
    package var sharpPixels: Int?
  }

  /// The version of the file format; incremented by incompatible changes.
  package static let currentFormat = 1

  package var format = Self.currentFormat
  /// Absolute.
  package var photoFolder: String
  /// The registered photos, in the order of `sparse/images.txt`.
  package var photos: [PhotoFile]
  /// The number of pixels per view in the dense stage.
  package var viewPixels: Int
  /// The maximum number of pixels of a photo in all stages.
  package var processingPixels: Int
  package var worldFrame: WorldFrame
  /// The hash of the cameras and poses in `sparse/`.
  package var sparseHash: String

  init(
    _ reconstruction: Reconstruction, of ingested: IngestedPhotos, in folder: URL, viewPixels: Int,
    sparseHash: String
  ) {
    photoFolder = folder.standardizedFileURL.path
    photos = reconstruction.registered.map { id in
      PhotoFile(
        name: ingested.photos[id.index].name,
        contentHash: ingested.contentHashes[id.index].hexadecimalDigits,
        mask: ingested.photos[id.index].mask,
        sharpPixels: ingested.photos[id.index].sharpPixels)
    }
    self.viewPixels = viewPixels
    processingPixels = ingested.processingPixels
    worldFrame = reconstruction.worldFrame
    self.sparseHash = sparseHash
  }

  /// The record as JSON with sorted keys.
  func encoded() throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return try encoder.encode(self)
  }
}
