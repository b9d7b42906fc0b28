import Evaluation
import Formats
import Foundation
import SceneModel

/// One side of a comparison, read from disk.
struct EvaluationInput {
  var reconstruction: Reconstruction?
  var cameras: [NamedCamera] = []
  var mesh: Mesh?
  var cloud: SceneModel.PointCloud?

  /// Reads a checkpoint directory, a COLMAP text folder or a PLY file.
  static func result(_ path: String) throws -> EvaluationInput {
    let url = URL(fileURLWithPath: path)
    var input = EvaluationInput()
    switch try kind(of: path) {
    case .file:
      guard url.pathExtension.lowercased() == "ply" else {
        throw CommandFailure.usage(
          "\(path) is not a PLY file. Name a PLY file, or the checkpoint directory of a run.")
      }
      let mesh = try PLY.readMesh(url)
      if mesh.triangles.isEmpty {
        input.cloud = try PLY.readPointCloud(url)
      } else {
        input.mesh = mesh
      }
    case .folder:
      input.reconstruction = try sparse(in: url).map { try COLMAPText.read($0) }
      let surface = url.appendingPathComponent("mesh/surface.ply")
      if exists(surface) { input.mesh = try PLY.readMesh(surface) }
      let points = url.appendingPathComponent("dense/points.ply")
      if exists(points) { input.cloud = try PLY.readPointCloud(points) }
      guard input.reconstruction != nil || input.mesh != nil || input.cloud != nil else {
        throw CommandFailure.usage(
          "\(path) holds no result: neither sparse/images.txt nor mesh/surface.ply nor "
            + "dense/points.ply. Name the checkpoint directory of a run, a folder with COLMAP's "
            + "text files, or a PLY file.")
      }
    }
    return input
  }

  /// Reads a folder with cameras.json and mesh.ply, or a COLMAP text folder.
  static func reference(_ path: String) throws -> EvaluationInput {
    guard case .folder = try kind(of: path) else {
      throw CommandFailure.usage(
        "\(path) is a file. Name the folder that holds the reference: cameras.json, mesh.ply or "
          + "COLMAP's text files.")
    }
    let folder = URL(fileURLWithPath: path, isDirectory: true)
    var input = EvaluationInput()
    for place in [folder.appendingPathComponent("gt", isDirectory: true), folder] {
      let cameras = place.appendingPathComponent("cameras.json")
      if input.cameras.isEmpty, exists(cameras) {
        input.cameras = try NamedCamera.cameras(json: try Data(contentsOf: cameras))
      }
      let mesh = place.appendingPathComponent("mesh.ply")
      if input.mesh == nil, exists(mesh) { input.mesh = try PLY.readMesh(mesh) }
    }
    if input.cameras.isEmpty, let sparse = sparse(in: folder) {
      input.cameras = NamedCamera.cameras(of: try COLMAPText.read(sparse))
    }
    guard !input.cameras.isEmpty || input.mesh != nil else {
      throw CommandFailure.usage(
        "\(path) holds no reference: neither cameras.json nor mesh.ply nor images.txt, directly "
          + "in it or in gt/ or sparse/. Name the folder with the ground truth.")
    }
    return input
  }

  private enum Kind { case file, folder }

  private static func kind(of path: String) throws -> Kind {
    var isDirectory: ObjCBool = false
    guard FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory) else {
      throw CommandFailure.usage("\(path) does not exist. Check the path.")
    }
    return isDirectory.boolValue ? .folder : .file
  }

  private static func exists(_ url: URL) -> Bool {
    FileManager.default.fileExists(atPath: url.path)
  }

  /// The folder with COLMAP's text files at or below `folder`.
  private static func sparse(in folder: URL) -> URL? {
    ["", "sparse", "sparse/0"].map { folder.appendingPathComponent($0, isDirectory: true) }
      .first { exists($0.appendingPathComponent("images.txt")) }
  }
}
