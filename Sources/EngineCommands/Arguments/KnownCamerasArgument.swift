import Evaluation
import Formats
import Foundation
import Pipeline
import SceneModel
import SharedCommands

/// A folder of cameras on the command line.
struct KnownCamerasArgument {
  let cameras: KnownCameras

  /// Reads COLMAP's files, in the folder or in its sparse/ or sparse/0/, or a cameras.json without
  /// the photos that it marks as held out.
  ///
  /// Throws a `CommandFailure` if there are no usable cameras. With `isMetric` their unit is the
  /// meter; otherwise the report.json that `align` writes next to sparse/ determines the scale.
  init(_ path: String, isMetric: Bool) throws {
    let folder = try FolderArgument.url(path, holding: "cameras")
    do {
      var cameras = try Self.read(folder, path)
      cameras.reconstruction.worldFrame = Self.worldFrame(folder, isMetric: isMetric)
      self.cameras = cameras
    } catch let failure as CommandFailure {
      throw failure
    } catch {
      throw CommandFailure.usage(CommandFailure(error).sentence)
    }
  }

  private static func read(_ folder: URL, _ path: String) throws -> KnownCameras {
    if let reconstruction = try COLMAPFolder.read(folder) { return KnownCameras(reconstruction) }
    if exists(folder, "cameras.json") {
      return try cameras(json: folder.appendingPathComponent("cameras.json"))
    }
    throw CommandFailure.usage(
      "\(path) holds no cameras: neither COLMAP's files, directly in it or in sparse/ or "
        + "sparse/0/, nor cameras.json.")
  }

  private static func cameras(json file: URL) throws -> KnownCameras {
    let named: [NamedCamera]
    do {
      named = try NamedCamera.cameras(json: try Data(contentsOf: file)).filter { !$0.isHeldOut }
    } catch EvaluationError.invalidReference(let reason) {
      throw CommandFailure.usage("\(file.relativePath) can't be used: \(reason).")
    }
    let photos = named.enumerated().map { index, entry in
      Photo(
        id: ID(index), sampleID: index, name: entry.name, url: file, width: entry.camera.width,
        height: entry.camera.height, orientation: 1, camera: ID(index))
    }
    return KnownCameras(
      Reconstruction(
        cameras: named.map(\.camera), photos: photos, poses: named.map(\.cameraFromWorld),
        points: []),
      photosOfUnknownSize: Set(named.indices.filter { !named[$0].isSizeKnown }.map { ID($0) }))
  }

  /// The part of report.json that is read, whatever version wrote it.
  private struct Report: Decodable {
    var worldFrame: WorldFrame?
  }

  /// The source of the scale.
  private static func worldFrame(_ folder: URL, isMetric: Bool) -> WorldFrame {
    if isMetric { return WorldFrame(scale: .given) }
    let report = folder.appendingPathComponent("report.json")
    guard exists(folder, "sparse/images.txt"), let data = try? Data(contentsOf: report) else {
      return WorldFrame()
    }
    return (try? JSONDecoder().decode(Report.self, from: data))?.worldFrame ?? WorldFrame()
  }

  private static func exists(_ folder: URL, _ name: String) -> Bool {
    FileManager.default.fileExists(atPath: folder.appendingPathComponent(name).path)
  }
}
