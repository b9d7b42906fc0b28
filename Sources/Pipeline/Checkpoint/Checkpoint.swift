import Formats
import Foundation
import Kernels
import SceneModel

/// The intermediate results of a run as files that other tools read, in the model's frame.
///
/// ```
/// sparse/{cameras,images,points3D}.txt    COLMAP text
/// dense/points.ply                        oriented, coloured patches
/// dense/views/                            what the dense stage has made of each view, to go on with
/// mesh/surface.ply                        before simplification
/// mesh/surface.json                       what it was made of
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

  /// Where COLMAP's text files are.
  var sparse: URL { directory.appendingPathComponent("sparse", isDirectory: true) }
  var surface: URL { directory.appendingPathComponent("mesh/surface.ply") }
  var record: URL { directory.appendingPathComponent("mesh/surface.json") }

  /// Tells whether cameras and poses are the same; nil where there are none.
  var sparseHash: String? {
    var fingerprint = Fingerprint()
    for name in ["cameras.txt", "images.txt"] {
      let file = sparse.appendingPathComponent(name)
      guard let content = FileManager.default.contents(atPath: file.path) else { return nil }
      fingerprint.add(content)
    }
    return SurfaceRecord.text(fingerprint.value)
  }

  func write(_ mesh: Mesh) throws {
    _ = try folder("mesh")
    try PLY.write(mesh, to: surface)
  }

  /// Writes what the surface was made of; after the surface, so that one without is of a run that was
  /// stopped.
  func write(_ content: SurfaceRecord) throws {
    try AtomicFile.write(try content.encoded(), to: record)
  }

  /// Takes the record away before its surface changes.
  func removeRecord() { try? FileManager.default.removeItem(at: record) }

  func write(_ report: RunReport) throws {
    try FileManager.default.createDirectory(at: directory, withIntermediateDirectories: true)
    try AtomicFile.write(
      try report.encoded(), to: directory.appendingPathComponent("report.json"))
  }

  /// Removes what runs that were killed had not finished.
  func removeRemains() {
    for name in ["", "sparse", "dense", "mesh", "stages"] {
      UnfinishedFiles.remove(from: directory.appendingPathComponent(name, isDirectory: true))
    }
  }

  private func folder(_ name: String) throws -> URL {
    let url = directory.appendingPathComponent(name, isDirectory: true)
    try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
    return url
  }
}
