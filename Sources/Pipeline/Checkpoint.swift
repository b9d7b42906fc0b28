import Formats
import Foundation
import SceneModel

/// The intermediate results of a run as files that other tools read, in the model's frame.
///
/// ```
/// sparse/{cameras,images,points3D}.txt    COLMAP text
/// dense/points.ply                        oriented, coloured patches
/// dense/views/                            what the dense stage has made of each view, to go on with
/// mesh/surface.ply                        before simplification
/// report.json
/// ```
/// Every file is written whole or not at all.
struct Checkpoint {
  let directory: URL

  init(directory: URL) {
    self.directory = directory
  }

  func write(_ reconstruction: Reconstruction) throws {
    try COLMAPText.write(reconstruction, to: try folder("sparse"))
  }

  func write(_ cloud: PointCloud) throws {
    try PLY.write(cloud, to: try folder("dense").appendingPathComponent("points.ply"))
  }

  /// The folder of `PatchWorkspace`.
  var views: URL { directory.appendingPathComponent("dense/views", isDirectory: true) }

  func write(_ surface: Mesh) throws {
    try PLY.write(surface, to: try folder("mesh").appendingPathComponent("surface.ply"))
  }

  func write(_ report: RunReport) throws {
    try FileManager.default.createDirectory(at: directory, withIntermediateDirectories: true)
    try AtomicFile.write(
      try report.encoded(), to: directory.appendingPathComponent("report.json"))
  }

  private func folder(_ name: String) throws -> URL {
    let url = directory.appendingPathComponent(name, isDirectory: true)
    try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
    return url
  }
}
