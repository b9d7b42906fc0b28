import Evaluation
import Formats
import Foundation
import Kernels
import Pipeline
import SceneModel
import SharedCommands

/// One side of a comparison, read from disk.
struct EvaluationInput {
  var reconstruction: Reconstruction?
  var cameras: [NamedCamera] = []
  var model: LoadedModel?
  var cloud: SceneModel.PointCloud?
  /// Masks, if the folder holds nothing else.
  var masks: MaskFolder?
  /// The content of the run's report.json.
  var report: Data?

  /// Reads what a path names: a checkpoint directory, a folder of COLMAP's files, cameras as JSON
  /// or XML, a model, a cloud, or a folder of masks.
  ///
  /// Throws a `CommandFailure` if it can't be read.
  init(result path: String) throws {
    try read(path) { $0 ? try $1.readFolder($2) : try $1.readFile($2) }
    if let reconstruction { cameras = NamedCamera.cameras(of: reconstruction) }
    guard reconstruction != nil || !cameras.isEmpty || model != nil || cloud != nil || masks != nil
    else {
      throw CommandFailure.usage(
        "\(path) holds no result. Name the checkpoint directory of a run, a folder with COLMAP's "
          + "files, cameras as JSON or XML, a model, or a folder of masks.")
    }
  }

  /// Reads a folder with cameras and a surface, or a file of either. Throws a `CommandFailure`.
  init(reference path: String) throws {
    try read(path) { $0 ? try $1.readReference($2) : try $1.readFile($2) }
    if let reconstruction, cameras.isEmpty {
      cameras = NamedCamera.cameras(of: reconstruction)
    }
    guard !cameras.isEmpty || model != nil else {
      throw CommandFailure.usage(
        "\(path) holds no reference: neither cameras.json nor mesh.ply nor COLMAP's files, "
          + "directly in it or in gt/ or sparse/. Name the folder with the ground truth.")
    }
  }

  /// Replaces the surface by that of a model, or the cloud by the points of a PLY file. Throws a
  /// `CommandFailure`.
  mutating func readModel(_ path: String) throws {
    model = nil
    try read(path) { try $1.readSurface($2) }
  }

  /// Calls `body` with whether the path is a folder, and makes its errors those of the arguments.
  private mutating func read(
    _ path: String, _ body: (Bool, inout EvaluationInput, URL) throws -> Void
  ) throws {
    do {
      try body(try Self.isFolder(path), &self, URL(fileURLWithPath: path))
    } catch EvaluationError.invalidReference(let reason) {
      throw CommandFailure.usage("\(path) can't be used: \(reason).")
    } catch let error where !(error is CommandFailure) {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
  }
}

extension EvaluationInput {
  private mutating func readFile(_ url: URL) throws {
    switch url.pathExtension.lowercased() {
    case "json": cameras = try NamedCamera.cameras(json: try Data(contentsOf: url))
    case "xml": reconstruction = try MetashapeCameras.read(url)
    default: try readSurface(url)
    }
  }

  private mutating func readSurface(_ url: URL) throws {
    guard url.pathExtension.lowercased() == "ply" else {
      model = try ModelFile.read(url, decompressedBy: MeshoptDecoder())
      return
    }
    let mesh = try PLY.readMesh(url)
    if mesh.triangles.isEmpty {
      cloud = try PLY.readPointCloud(url)
    } else {
      model = LoadedModel(mesh)
    }
  }

  private mutating func readFolder(_ folder: URL) throws {
    reconstruction = try COLMAPFolder.read(folder)
    let surface = folder.appendingPathComponent("mesh/surface.ply")
    if Self.exists(surface) { model = try ModelFile.read(surface) }
    let points = folder.appendingPathComponent("dense/points.ply")
    if Self.exists(points) { cloud = try PLY.readPointCloud(points) }
    report = try? Data(contentsOf: folder.appendingPathComponent("report.json"))
    guard reconstruction == nil, model == nil, cloud == nil else { return }
    if Self.isModel(folder) {
      model = try ModelFile.read(folder)
    } else {
      let masks = MaskFolder(folder)
      self.masks = masks.isEmpty ? nil : masks
    }
  }

  private mutating func readReference(_ folder: URL) throws {
    for place in [folder.appendingPathComponent("gt", isDirectory: true), folder] {
      let file = place.appendingPathComponent("cameras.json")
      if cameras.isEmpty, Self.exists(file) {
        cameras = try NamedCamera.cameras(json: try Data(contentsOf: file))
      }
      let mesh = place.appendingPathComponent("mesh.ply")
      if model == nil, Self.exists(mesh) { model = try ModelFile.read(mesh) }
    }
    if cameras.isEmpty { reconstruction = try COLMAPFolder.read(folder) }
  }

  private static func isModel(_ folder: URL) -> Bool {
    let names = (try? FileManager.default.contentsOfDirectory(atPath: folder.path)) ?? []
    return names.contains { $0.lowercased().hasSuffix(".obj") }
  }

  private static func isFolder(_ path: String) throws -> Bool {
    var isDirectory: ObjCBool = false
    guard FileManager.default.fileExists(atPath: path, isDirectory: &isDirectory) else {
      throw CommandFailure.usage("\(path) does not exist. Check the path.")
    }
    return isDirectory.boolValue
  }

  private static func exists(_ url: URL) -> Bool {
    FileManager.default.fileExists(atPath: url.path)
  }
}
