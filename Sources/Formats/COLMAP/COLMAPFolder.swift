import Foundation
import SceneModel

/// A folder with COLMAP's files of a sparse model, text or binary.
package enum COLMAPFolder {
  /// Reads the model in the folder, or in its sparse/ or sparse/0/; nil if there is none. Text is
  /// preferred. Throws `FormatError` and `UnsupportedCameraModel`.
  package static func read(_ folder: URL) throws -> Reconstruction? {
    let places = ["", "sparse", "sparse/0"].map {
      folder.appendingPathComponent($0, isDirectory: true)
    }
    func exists(_ place: URL, _ name: String) -> Bool {
      FileManager.default.fileExists(atPath: place.appendingPathComponent(name).path)
    }
    if let place = places.first(where: { exists($0, "images.txt") }) {
      return try COLMAPText.read(place)
    }
    if let place = places.first(where: { exists($0, "images.bin") }) {
      return try COLMAPBinary.read(place)
    }
    return nil
  }
}
