import Foundation

extension OBJFolder {
  /// The OBJ file of a folder: that of `ModelContent.name`, or the only one. Throws an
  /// `UnsupportedFeature` without it.
  static func object(in folder: URL) throws -> URL {
    let names = (try? FileManager.default.contentsOfDirectory(atPath: folder.path)) ?? []
    let objects = names.filter { $0.lowercased().hasSuffix(".obj") && !$0.hasPrefix(".") }
    let usual = "\(ModelContent.name).obj"
    guard let name = objects.contains(usual) ? usual : objects.count == 1 ? objects[0] : nil else {
      throw UnsupportedFeature(
        reason: objects.isEmpty
          ? "the folder contains no OBJ file" : "the folder contains several OBJ files",
        remedy: "Name the file of the model.")
    }
    return folder.appendingPathComponent(name)
  }
}
