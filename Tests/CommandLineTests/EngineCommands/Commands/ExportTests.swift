import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline
@testable import EngineCommands
@testable import SharedCommands

@Suite(.endToEnd) struct ExportTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  /// Writes the checkpoint of a finished run on photos of a sphere.
  private func makeCheckpoint() throws {
    let scene = SphereScene(viewCount: 8, imageSize: 320) { p in
      SIMD3(140 + 90 * sin(19 * p.x), 120 + 60 * sin(31 * p.z), 100 + 50 * sin(25 * p.y))
    }
    try temporary.writePhotos(scene.images)
    let photos = folder.appendingPathComponent("photos", isDirectory: true)
    let ingested = try PhotoIngestion().run(folder: photos, StageContext())
    var reconstruction = scene.reconstruction
    reconstruction.photos = ingested.photos
    for index in reconstruction.photos.indices { reconstruction.photos[index].camera = ID(0) }
    let work = folder.appendingPathComponent("work", isDirectory: true)
    try FileManager.default.createDirectory(at: work, withIntermediateDirectories: true)
    let checkpoint = Checkpoint(directory: work)
    try checkpoint.write(reconstruction)
    try checkpoint.write(SyntheticMesh.sphere(subdivisions: 4))
    try checkpoint.write(
      SurfaceRecord(
        reconstruction, of: ingested, in: photos, viewPixels: 80_000,
        sparseHash: try #require(checkpoint.sparseHash)))
  }

  private func expectFailure(
    _ arguments: [String], code: Int32, mentioning words: [String]
  ) throws {
    try CommandProcess.expectFailure(
      ["export"] + arguments, in: folder, code: code, mentioning: words)
    #expect(!FileManager.default.fileExists(atPath: folder.path + "/m.usdz"))
  }

  @Test(arguments: [SIGINT, SIGTERM])
  func interruptLeavesNoModel(_ signal: Int32) throws {
    try makeCheckpoint()
    let run = try CommandProcess.run(
      ["export", "work", "m.usdz", "-d", "full"], in: folder
    ) { kill($0.processIdentifier, signal) }
    #expect(run.exitCode == 130 && run.output.isEmpty, "\(run.errors)")
    #expect(run.errors.contains("no model was written"))
    #expect(try !FileManager.default.contentsOfDirectory(atPath: folder.path).contains("m.usdz"))
  }

  @Test func modelAndPreviewAreWritten() throws {
    try makeCheckpoint()
    let run = try CommandProcess.run(
      ["export", "work", "m.usdz", "-d", "reduced", "--preview", "m.png", "--report", "r.json"],
      in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output == "m.usdz\nm.png\n")
    #expect(run.errors.contains("0.08 MP") && run.errors.contains("Done in"), "\(run.errors)")
    let sheet = try ImageCodec.decode(
      [UInt8](try Data(contentsOf: folder.appendingPathComponent("m.png"))))
    #expect(max(sheet.width / 4, sheet.height / 2) == 480)
    let report = try JSONDecoder().decode(
      RunReport.self, from: Data(contentsOf: folder.appendingPathComponent("r.json")))
    #expect(report.stages.map(\.name) == ["preProcessing", "textureMapping", "optimization"])
    #expect(report.warnings.count == 1)
    for stage in report.stages {
      #expect(stage.serialSeconds <= stage.seconds + 0.05)
      #expect(stage.steps.allSatisfy { $0.seconds <= stage.seconds + 0.05 })
    }
    let steps = Set(report.stages.flatMap(\.steps).map(\.name))
    #expect(steps.isSuperset(of: ["simplification", "labels", "layout", "painting", "export"]))
    let left = try FileManager.default.subpathsOfDirectory(atPath: folder.path + "/work").sorted()
    #expect(
      left == [
        "mesh", "mesh/surface.json", "mesh/surface.ply", "sparse", "sparse/cameras.txt",
        "sparse/images.txt", "sparse/points3D.txt",
      ])
  }

  /// The lower levels are those that separate exports give; the preview shows the named model.
  @Test func lowerLevelsAreWritten() throws {
    try makeCheckpoint()
    let run = try CommandProcess.run(
      ["export", "work", "m.glb", "--lod", "--compress", "--preview", "m.png"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(run.output == "m-preview.glb\nm.glb\nm.png\n")
    let single = try CommandProcess.run(
      ["export", "work", "s.glb", "-d", "preview", "--compress"], in: folder)
    #expect(single.exitCode == 0, "\(single.errors)")
    let contents = try ["m-preview.glb", "s.glb"].map {
      try Data(contentsOf: folder.appendingPathComponent($0))
    }
    #expect(contents[0] == contents[1])
    #expect(contents[0].range(of: Data("EXT_meshopt_compression".utf8)) != nil)
  }

  @Test func optionsThatDoNotFitTheOutputAreUsageErrors() throws {
    try makeCheckpoint()
    try expectFailure(["work", "m.usdz", "--compress"], code: 2, mentioning: [".glb"])
    try expectFailure(["work", "m/", "--lod"], code: 2, mentioning: ["--lod", "folder"])
  }

  @Test func croppedQuadsAreWritten() throws {
    try makeCheckpoint()
    let run = try CommandProcess.run(
      [
        "export", "work", "m/", "-d", "custom", "--max-polygons", "900", "--texture-side", "1024",
        "--maps", "color", "--quads", "--crop", "-2,-2,-2,2,0.25,2",
      ], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    let lines = try String(contentsOfFile: folder.path + "/m/baked_mesh.obj", encoding: .utf8)
      .split(separator: "\n").map { $0.split(separator: " ") }
    let corners = lines.filter { $0.first == "f" }.map { $0.count - 1 }
    #expect(corners.count < 900 && corners.filter { $0 == 4 }.count > corners.count / 2)
    #expect(Set(corners) == [3, 4])
    let heights = lines.filter { $0.first == "v" }.compactMap { Float($0[2]) }
    #expect(abs((heights.max() ?? 9) - 0.25) < 0.01 && (heights.min() ?? 0) < -0.95)
    try expectFailure(
      ["work", "m.usdz", "--crop", "3,3,3,4,4,4"], code: 1, mentioning: ["bounds", "frame"])
  }

  @Test func customLimitsAreKept() throws {
    try makeCheckpoint()
    let run = try CommandProcess.run(
      [
        "export", "work", "m/", "-d", "custom", "--max-polygons", "500", "--texture-side", "1024",
        "--maps", "color,normal", "--texture-format", "jpeg:0.6",
      ], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    let files = try FileManager.default.contentsOfDirectory(atPath: folder.path + "/m")
    // Normal maps stay lossless.
    #expect(files.filter { $0.hasSuffix(".jpg") }.count == 1, "\(files)")
    #expect(files.filter { $0.hasSuffix(".png") }.count == 1, "\(files)")
    let name = try #require(files.first { $0.hasSuffix(".obj") })
    let lines = try String(contentsOfFile: folder.path + "/m/" + name, encoding: .utf8)
      .split(separator: "\n")
    let faces = lines.count { $0.hasPrefix("f ") }
    #expect(faces > 400 && faces <= 500)
    for file in files where file.hasSuffix(".jpg") || file.hasSuffix(".png") {
      let texture = try ImageCodec.decode(
        [UInt8](try Data(contentsOf: folder.appendingPathComponent("m/" + file))))
      #expect(texture.width <= 1024 && texture.width == texture.height)
    }
  }

  @Test func unfinishedRunExitsWithTwo() throws {
    try temporary.write([1], as: "empty/x")
    try temporary.write([1], as: "begun/sparse/images.txt")
    try expectFailure([], code: 2, mentioning: ["checkpoint-directory"])
    try expectFailure(["none", "m.usdz"], code: 2, mentioning: ["none does not exist"])
    try expectFailure(["empty", "m.usdz"], code: 2, mentioning: ["empty holds no checkpoint"])
    try expectFailure(["begun", "m.usdz"], code: 2, mentioning: ["has no finished surface"])
    try expectFailure(
      ["begun", "m.usdz", "--photos", "none"], code: 2, mentioning: ["none does not exist"])
    try expectFailure(
      ["begun", "m.usdz", "--preview", "m.jpg"], code: 2, mentioning: ["m.jpg", ".png"])
    try expectFailure(["begun", "no/m.usdz"], code: 2, mentioning: ["mkdir -p"])
  }

  @Test func changedPhotosExitWithOne() throws {
    try makeCheckpoint()
    try temporary.write([1, 2, 3], as: "photos/p2.jpg")
    try expectFailure(["work", "m.usdz"], code: 1, mentioning: ["p2.jpg", "have changed"])
  }
}
