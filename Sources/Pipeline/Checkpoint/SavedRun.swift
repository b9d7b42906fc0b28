import Formats
import Foundation
import SceneModel

/// The checkpoint of an earlier run, sufficient to make further models of the same surface.
///
/// Numbers are restored bit for bit, so a model of the same detail level is identical.
package struct SavedRun: Sendable {
  /// Its photos have names, sizes and cameras; their files have not been read yet.
  package let reconstruction: Reconstruction
  package let surface: Mesh
  package let record: SurfaceRecord
  /// The folder of the estimated masks, if there are any.
  let maskFolder: URL
  /// The files of the dense points, if there are any, and of the report.
  let cloudFile: URL
  let reportFile: URL
  /// The current folder of the photos.
  package let photoFolder: URL

  /// Reads a checkpoint directory. `photos` is the folder of the photos if they were moved. Throws
  /// `SavedRunError`.
  package init(checkpoint directory: URL, photos: URL? = nil) throws {
    let checkpoint = Checkpoint(directory: directory)
    (maskFolder, cloudFile) = (checkpoint.masks, checkpoint.cloud)
    reportFile = checkpoint.report
    try Self.checkPresence(checkpoint)
    record = try Self.record(checkpoint)
    photoFolder = photos ?? URL(fileURLWithPath: record.photoFolder, isDirectory: true)
    guard checkpoint.sparseHash == record.sparseHash else {
      throw SavedRunError.mixed(directory: directory.path)
    }
    do {
      reconstruction = try COLMAPText.read(checkpoint.sparse, images: photoFolder)
      surface = try PLY.readMesh(checkpoint.surface)
    } catch FormatError.malformed(let path, let reason) {
      throw SavedRunError.damaged(path: path, reason: reason)
    } catch FormatError.unreadable(let path, let reason) {
      throw SavedRunError.damaged(path: path, reason: reason)
    }
    guard reconstruction.photos.map(\.name) == record.photos.map(\.name) else {
      throw SavedRunError.mixed(directory: directory.path)
    }
    try checkSurface(checkpoint.surface)
    try checkPhotos()
  }

  private static func checkPresence(_ checkpoint: Checkpoint) throws {
    let files = FileManager.default
    let path = checkpoint.directory.path
    guard checkpoint.directory.isExistingFolder else {
      throw SavedRunError.noDirectory(path: path)
    }
    let poses = checkpoint.sparse.appendingPathComponent("images.txt")
    guard files.fileExists(atPath: poses.path) else {
      throw SavedRunError.noCheckpoint(directory: path)
    }
    guard files.fileExists(atPath: checkpoint.surface.path) else {
      throw SavedRunError.unfinished(directory: path)
    }
    guard files.fileExists(atPath: checkpoint.record.path) else {
      throw SavedRunError.noRecord(path: checkpoint.record.path)
    }
  }

  private static func record(_ checkpoint: Checkpoint) throws -> SurfaceRecord {
    struct Version: Decodable { var format: Int }
    let path = checkpoint.record.path
    guard let data = FileManager.default.contents(atPath: path) else {
      throw SavedRunError.damaged(path: path, reason: "it can't be read")
    }
    guard let version = try? JSONDecoder().decode(Version.self, from: data) else {
      throw SavedRunError.damaged(path: path, reason: "it is not a record of this program")
    }
    guard version.format == SurfaceRecord.currentFormat else {
      throw SavedRunError.otherVersion(path: path, format: version.format)
    }
    do {
      return try JSONDecoder().decode(SurfaceRecord.self, from: data)
    } catch {
      throw SavedRunError.damaged(path: path, reason: "entries are missing")
    }
  }

  private func checkSurface(_ url: URL) throws {
    guard !surface.triangles.isEmpty else {
      throw SavedRunError.damaged(path: url.path, reason: "it has no triangles")
    }
    guard surface.normals.allSatisfy({ $0.squaredLength.isFinite }) else {
      throw SavedRunError.damaged(path: url.path, reason: "a normal is not finite")
    }
  }

  private func checkPhotos() throws {
    let files = FileManager.default
    guard files.fileExists(atPath: photoFolder.path) else {
      throw SavedRunError.noPhotos(folder: photoFolder.path)
    }
    let missing = record.photos.map(\.name).filter {
      !files.fileExists(atPath: photoFolder.appendingPathComponent($0).path)
    }
    guard missing.isEmpty else {
      throw SavedRunError.missingPhotos(folder: photoFolder.path, names: missing)
    }
  }
}
