import Foundation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands
@testable import SharedCommands

@Suite(.endToEnd) struct DensifyTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  private func expectFailure(
    _ arguments: [String], code: Int32, mentioning words: [String]
  ) throws {
    try CommandProcess.expectFailure(
      ["densify"] + arguments, in: folder, code: code, mentioning: words)
  }

  /// A ball above a floor.
  private static let scene: RaycastScene = {
    var options = RaycastScene.Options()
    (options.width, options.height) = (420, 316)
    return RaycastScene(options)
  }()

  /// Writes photos of the scene, and its exact cameras as COLMAP's text files.
  private func writePhotosAndCameras(to cameras: String) throws {
    try temporary.writePhotos(Self.scene.views.map(\.image))
    let poses = Self.scene.views.enumerated().map { index, view in
      let (q, t) = (view.cameraFromWorld.rotation, view.cameraFromWorld.translation)
      return "\(index + 1) \(q.w) \(q.x) \(q.y) \(q.z) \(t.x) \(t.y) \(t.z) 1 p\(index).jpg\n\n"
    }
    try temporary.write(
      "1 SIMPLE_PINHOLE 420 316 462 210 158\n", as: "\(cameras)/cameras.txt")
    try temporary.write(poses.joined(), as: "\(cameras)/images.txt")
  }

  @Test(arguments: [SIGINT, SIGTERM])
  func interruptLeavesNoCloudAndTheSameCommandResumes(_ signal: Int32) throws {
    try writePhotosAndCameras(to: "rig/sparse/0")
    let command = ["densify", "photos", "rig", "work", "--view-pixels", "30000"]
    let run = try CommandProcess.run(command, in: folder) { kill($0.processIdentifier, signal) }
    #expect(run.exitCode == 130 && run.output.isEmpty, "\(run.errors)")
    let cloud = folder.path + "/work/dense/points.ply"
    #expect(!FileManager.default.fileExists(atPath: cloud))
    #expect(try CommandProcess.run(command, in: folder).exitCode == 0)
    #expect(FileManager.default.fileExists(atPath: cloud))
  }

  @Test func camerasFromCOLMAPGiveACloud() throws {
    try writePhotosAndCameras(to: "rig/sparse/0")
    let run = try CommandProcess.run(
      [
        "densify", "photos", "rig", "work", "--view-pixels", "30000", "--metric", "--report",
        "r.json",
      ], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output == "work/dense/points.ply\n")
    #expect(run.errors.contains("triangulating points") && run.errors.contains("points/m³"))
    let report = try JSONDecoder().decode(
      RunReport.self, from: Data(contentsOf: folder.appendingPathComponent("r.json")))
    #expect(
      report.stages.map(\.name) == ["preProcessing", "imageAlignment", "pointCloudGeneration"])
    #expect(report.worldFrame?.scale == .given)
    #expect((report.stages.last?.counts["points"] ?? 0) > 5000)
    let files = try FileManager.default.subpathsOfDirectory(atPath: folder.path + "/work").sorted()
    #expect(
      files.filter { !$0.hasPrefix("dense/views/") }
        == [".lock", "dense", "dense/points.ply", "dense/views", "report.json"])
  }

  @Test func jobsProcessTheirShareOfTheViews() throws {
    try writePhotosAndCameras(to: "rig")
    let arguments = ["densify", "photos", "rig", "work", "--view-pixels", "10000"]
    let run = try CommandProcess.run(arguments + ["--job", "2/3"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output == "work/dense/views\n")
    let files = try FileManager.default.subpathsOfDirectory(atPath: folder.path + "/work").sorted()
    #expect(
      files.filter { $0.hasSuffix(".patches") }
        == ["dense/views/0001.patches", "dense/views/0004.patches"])
    let rest = try CommandProcess.run(arguments, in: folder)
    #expect(rest.exitCode == 0)
    #expect(rest.errors.contains("2 of 5 views"), "\(rest.errors)")
    for job in ["0/3", "4/3", "2", "a/b", "1/0"] {
      #expect(try CommandProcess.run(arguments + ["--job", job], in: folder).exitCode != 0)
    }
  }

  @Test func camerasOfOtherPhotosExitWithOne() throws {
    try temporary.writePhotos(Self.scene.views.map(\.image))
    let entries = (0..<4).map {
      #"{"name": "q\#($0).jpg", "K": [[462, 0, 210], [0, 462, 158], [0, 0, 1]], "#
        + #""R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "t": [0, 0, 0]}"#
    }
    try temporary.write("[\(entries.joined(separator: ","))]", as: "rig/cameras.json")
    try expectFailure(
      ["photos", "rig", "work"], code: 1,
      mentioning: ["p0.jpg is not used", "Only 0 of the 5 photos", "by file name"])
    let report = try JSONDecoder().decode(
      RunReport.self, from: Data(contentsOf: folder.appendingPathComponent("work/report.json")))
    #expect(report.errors.count == 1)
  }

  @Test func invalidArgumentsExitWithTwo() throws {
    try temporary.write("x", as: "photos/p.jpg")
    try temporary.write("x", as: "file")
    try expectFailure(["photos"], code: 2, mentioning: ["cameras-folder"])
    try expectFailure(
      ["nowhere", "photos", "work"], code: 2, mentioning: ["nowhere does not exist"])
    try expectFailure(["photos", "none", "work"], code: 2, mentioning: ["none does not exist"])
    try expectFailure(["photos", "file", "work"], code: 2, mentioning: ["file is a file"])
    try expectFailure(
      ["photos", "photos", "work"], code: 2, mentioning: ["holds no cameras", "cameras.json"])
    try expectFailure(
      ["photos", "photos", "work", "--view-pixels", "5"], code: 2, mentioning: ["10000"])
    #expect(!FileManager.default.fileExists(atPath: folder.path + "/work"))
  }

  @Test func unusableCamerasAreExplained() throws {
    try temporary.write("x", as: "photos/p.jpg")
    try temporary.write("", as: "binary/sparse/0/images.bin")
    try temporary.write("", as: "binary/sparse/0/cameras.bin")
    try expectFailure(
      ["photos", "binary", "work"], code: 2,
      mentioning: ["binary/sparse/0/cameras.bin", "ends too early"])
    try temporary.write("", as: "fisheye/images.txt")
    try temporary.write("1 OPENCV_FISHEYE 9 9 5 5 4 4 0 0 0 0\n", as: "fisheye/cameras.txt")
    try expectFailure(
      ["photos", "fisheye", "work"], code: 2,
      mentioning: ["OPENCV_FISHEYE", "colmap image_undistorter"])
    try temporary.write("[{}]", as: "json/cameras.json")
    try expectFailure(
      ["photos", "json", "work"], code: 2, mentioning: ["json/cameras.json", "name, K, R and t"])
    let mirrored =
      #"[{"name": "p.jpg", "K": [[9, 0, 5], [0, 9, 4], [0, 0, 1]], "#
      + #""R": [[1, 0, 0], [0, 1, 0], [0, 0, -1]], "t": [0, 0, 0]}]"#
    try temporary.write(mirrored, as: "mirror/cameras.json")
    try expectFailure(
      ["photos", "mirror", "work"], code: 2, mentioning: ["R of p.jpg is not a rotation"])
  }
}
