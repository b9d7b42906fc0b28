import Formats
import Foundation
import SceneRendering
import SharedCommands

/// The files of a demo, in a folder that holds nothing else.
struct DemoFolder {
  /// The folder as the user wrote it, without a slash at the end.
  let path: String

  var photos: String { "\(path)/\(Self.photosName)" }
  var model: String { "\(path)/\(Self.modelName)" }
  var picture: String { "\(path)/\(Self.pictureName)" }

  private static let photosName = "photos"
  private static let modelName = "model.usdz"
  private static let pictureName = "model.png"

  init(_ path: String) {
    let end = path.lastIndex { $0 != "/" }
    // The root folder is only slashes; an empty path is refused by `create`.
    self.path = end.map { String(path[...$0]) } ?? path
  }

  /// The file name of a photo. No camera names photos like that.
  static func photoName(_ index: Int) -> String {
    "demo_\(index < 10 ? "0" : "")\(index).jpg"
  }

  /// Creates the folder and that of the photos. Throws a `CommandFailure` if it can't be written,
  /// or holds anything but the files of an earlier demo with at most `photoCount` photos.
  func create(photoCount: Int) throws {
    guard !path.isEmpty else {
      throw CommandFailure.usage("The folder of the demo has no name. Name a folder, or none.")
    }
    if let other = try firstOtherFile(photoCount: photoCount) {
      throw CommandFailure.usage(
        "The folder \(path) holds \(other), which is not part of the demo. Name a new folder, for "
          + "instance \(path)-2.")
    }
    do {
      try FileManager.default.createDirectory(atPath: photos, withIntermediateDirectories: true)
    } catch {
      throw CommandFailure.usage(
        "The folder \(photos) can't be created. Check the permissions of the folder it is in, or "
          + "name another one: photogrammetry-cli demo <folder>.")
    }
    try ModelOutput.checkWritable(URL(fileURLWithPath: photos, isDirectory: true))
  }

  /// The first file, by name, that an earlier demo did not write; nil if there is none.
  private func firstOtherFile(photoCount: Int) throws -> String? {
    guard let names = try Self.contents(of: path) else { return nil }
    let photoNames = Set((0..<photoCount).map(Self.photoName))
    if names.contains(Self.photosName), let found = try Self.contents(of: photos),
      let other = found.first(where: { !photoNames.contains($0) })
    {
      return "\(Self.photosName)/\(other)"
    }
    // A model without the photos of a demo may be the user's.
    let own =
      names.contains(Self.photosName) ? [Self.photosName, Self.modelName, Self.pictureName] : []
    return names.first { !own.contains($0) }
  }

  /// The sorted names in a folder; nil if it doesn't exist. Throws a `CommandFailure` if it is a
  /// file or can't be read.
  private static func contents(of path: String) throws -> [String]? {
    guard FileManager.default.fileExists(atPath: path) else { return nil }
    guard let names = try? FileManager.default.contentsOfDirectory(atPath: path) else {
      throw CommandFailure.usage(
        "\(path) is a file, or a folder that can't be read. Name a new one.")
    }
    return names.sorted()
  }
}
