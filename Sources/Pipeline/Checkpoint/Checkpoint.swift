import Formats
import Foundation
import Kernels
import SceneModel

/// The intermediate results of a run as files that other tools can read, in the model's frame.
///
/// ```
/// sparse/{cameras,images,points3D}.txt    COLMAP text
/// masks/                                  estimated masks of the object
/// dense/points.ply                        oriented, colored patches
/// dense/views/                            patches of each view, to resume the dense stage
/// mesh/surface.ply                        before simplification
/// mesh/surface.json                       the inputs of the surface
/// tiles/                                  surfaces of tiles before they are joined
/// units/                                  features and matches that several processes share
/// report.json
/// ```
/// Every file is written atomically.
package struct Checkpoint: Sendable {
  let directory: URL

  init(directory: URL) {
    self.directory = directory
  }

  func write(_ reconstruction: Reconstruction) throws {
    try COLMAPText.write(reconstruction, to: try folder("sparse"))
  }

  func write(_ cloud: PointCloud) throws {
    _ = try folder("dense")
    try PLY.write(cloud, to: self.cloud)
  }

  var cloud: URL { directory.appendingPathComponent("dense/points.ply") }

  /// The folder of `PatchWorkspace`.
  var views: URL { directory.appendingPathComponent("dense/views", isDirectory: true) }

  /// Parts of stages that several processes make for each other. Nil if they are not to be written,
  /// and there are none.
  func units(isWritten: Bool) -> UnitStore? {
    let folder = directory.appendingPathComponent("units", isDirectory: true)
    if isWritten {
      try? FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    }
    return folder.isExistingFolder ? UnitStore(folder: folder, isWritten: isWritten) : nil
  }

  /// The folder of `TileStore`, which is created. Throws `OutputError`.
  func tileFolder() throws -> URL {
    do {
      return try folder("tiles")
    } catch {
      throw OutputError.notWritable(path: directory.path)
    }
  }

  /// The folder of COLMAP's text files.
  var sparse: URL { directory.appendingPathComponent("sparse", isDirectory: true) }
  /// The folder of estimated masks.
  var masks: URL { directory.appendingPathComponent("masks", isDirectory: true) }
  var surface: URL { directory.appendingPathComponent("mesh/surface.ply") }
  var record: URL { directory.appendingPathComponent("mesh/surface.json") }

  /// A hash of the cameras and poses, to detect changes; nil if there are none.
  var sparseHash: String? {
    var fingerprint = Fingerprint()
    for name in ["cameras.txt", "images.txt"] {
      let file = sparse.appendingPathComponent(name)
      guard let content = FileManager.default.contents(atPath: file.path) else { return nil }
      fingerprint.add(content)
    }
    return fingerprint.value.hexadecimalDigits
  }

  func write(_ mesh: Mesh) throws {
    _ = try folder("mesh")
    try PLY.write(mesh, to: surface)
  }

  /// Writes the record of the surface. Call it after the surface is written, so that a surface
  /// without a record indicates an interrupted run.
  func write(_ content: SurfaceRecord) throws {
    try AtomicFile.write(try content.encoded(), to: record)
  }

  /// Removes the record; call it before the surface changes.
  func removeRecord() { try? FileManager.default.removeItem(at: record) }

  func write(_ report: RunReport) throws {
    try FileManager.default.createDirectory(at: directory, withIntermediateDirectories: true)
    try AtomicFile.write(try report.encoded(), to: self.report)
  }

  var report: URL { directory.appendingPathComponent("report.json") }

  /// Removes the unfinished files of runs that were killed.
  func removeRemains() {
    for name in ["", "sparse", "masks", "dense", "mesh", "stages", "tiles"] {
      UnfinishedFiles.remove(from: directory.appendingPathComponent(name, isDirectory: true))
    }
  }

  private func folder(_ name: String) throws -> URL {
    let url = directory.appendingPathComponent(name, isDirectory: true)
    try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
    return url
  }
}
