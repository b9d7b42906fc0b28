import Foundation
import ImageFiles
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import SharedCommands

@Suite(.endToEnd) struct ExitCodeTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  /// Expects an error and no new files.
  private func expectFailure(
    _ arguments: [String], code: Int32, mentioning words: [String]
  ) throws {
    let before = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
    try CommandProcess.expectFailure(arguments, in: folder, code: code, mentioning: words)
    let after = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
    #expect(before == after)
  }

  @Test func invalidArgumentsExitWithTwo() throws {
    try temporary.writeNoisePhotos(1, to: "photos")
    try temporary.write("x", as: "file")
    try expectFailure([], code: 2, mentioning: ["input-folder"])
    try expectFailure(
      ["photos", "m.usdz", "-d", "huge"], code: 2, mentioning: ["huge", "preview"])
    try expectFailure(["nowhere", "m.usdz"], code: 2, mentioning: ["nowhere", "does not exist"])
    try expectFailure(["inspect", "file"], code: 2, mentioning: ["file is a file"])
    let photo = try #require(
      try FileManager.default.contentsOfDirectory(atPath: folder.path + "/photos").first)
    try expectFailure(
      ["photos/\(photo)", "m.usdz"], code: 2, mentioning: ["is a file", "photos: photos"])
    try expectFailure(
      ["photos", "m.obj"], code: 2, mentioning: [".obj", ".usdz", ".glb", "slash"])
    try expectFailure(["photos", ".usdz"], code: 2, mentioning: ["no name"])
    try expectFailure(["photos", "no/such/m.usdz"], code: 2, mentioning: ["m.usdz", "mkdir -p"])
    try expectFailure(
      ["photos", "m.usdz", "--poses", "no/p.json"], code: 2,
      mentioning: ["p.json", "mkdir -p"])
    try expectFailure(
      ["photos", "m.usdz", "--write-masks", "photos"], code: 2,
      mentioning: ["folder of the photos", "another folder"])
    try expectFailure(
      ["evaluate", "photos", "--reference", "photos"], code: 2,
      mentioning: ["holds no reference", "mesh.ply"])
    try temporary.write("x", as: "texts/readme")
    try expectFailure(["evaluate", "texts"], code: 2, mentioning: ["holds no result"])
    try expectFailure(["check", "photos"], code: 2, mentioning: ["photos"])
  }

  @Test func runsWithoutResultExitWithOne() throws {
    try FileManager.default.createDirectory(
      at: folder.appendingPathComponent("empty"), withIntermediateDirectories: true)
    for index in 0..<3 { try temporary.write("hello", as: "texts/\(index).txt") }
    try temporary.writeNoisePhotos(2, to: "two")
    try expectFailure(["empty", "m.usdz"], code: 1, mentioning: ["empty", "JPEG, HEIC or PNG"])
    try expectFailure(["texts", "m.usdz"], code: 1, mentioning: ["error: ", "JPEG, HEIC or PNG"])
    try expectFailure(["two", "m.usdz"], code: 1, mentioning: ["error: ", "2"])
  }

  @Test func reportHasTheReasonOfAFailure() throws {
    try temporary.writeNoisePhotos(2, to: "two")
    let align = try CommandProcess.run(
      ["align", "two", "aligned", "--report", "r.json"], in: folder)
    #expect(align.exitCode == 1 && align.output.isEmpty, "\(align.errors)")
    let model = try CommandProcess.run(
      ["two", "m.usdz", "--checkpoint-directory", "made", "--report", "q.json"], in: folder)
    #expect(model.exitCode == 1, "\(model.errors)")
    for name in ["aligned/report.json", "r.json", "made/report.json", "q.json"] {
      let data = try Data(contentsOf: folder.appendingPathComponent(name))
      let report = try JSONDecoder().decode(RunReport.self, from: data)
      let error = PipelineError.tooFewPhotos(found: 2, needed: 3)
      let sentences = [error.errorDescription, error.recoverySuggestion].compactMap(\.self)
      #expect(report.errors == [sentences.joined(separator: " ")])
      #expect(report.stages.map(\.name) == ["preProcessing"])
    }
  }

  @Test func inspectListsEveryFile() throws {
    try temporary.writeNoisePhotos(3, to: "photos")
    try temporary.write("hello", as: "photos/notes.txt")
    let run = try CommandProcess.run(["inspect", "photos"], in: folder)
    #expect(run.exitCode == 0)
    #expect(run.output.contains("p1.jpg  800 x 600"))
    #expect(run.output.contains("notes.txt is not used"))
    #expect(run.output.contains("3 photos of 1 camera would be used, 1 file not."))
    let json = try CommandProcess.run(["inspect", "photos", "--json"], in: folder)
    let value = try JSONSerialization.jsonObject(with: Data(json.output.utf8))
    let used = (value as? [String: Any])?["used"] as? [[String: Any]]
    #expect(used?.compactMap { $0["name"] as? String } == ["p0.jpg", "p1.jpg", "p2.jpg"])
  }

  @Test func dryRunPrintsThePlanOnly() throws {
    try temporary.writeNoisePhotos(3, to: "photos")
    try temporary.writeNoisePhotos(2, to: "two")
    let run = try CommandProcess.run(["photos", "m.usdz", "--dry-run"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    for words in ["p1.jpg  800 x 600", "3 photos of 1 camera", "m.usdz would be", "It would take"] {
      #expect(run.output.contains(words), "\(run.output)")
    }
    let json = try CommandProcess.run(
      ["photos", "m.usdz", "--dry-run", "--json", "-d", "full"], in: folder)
    let plan = try #require(RunEvent(line: json.output.utf8))
    #expect(plan.event == "plan" && plan.photos == 3 && (plan.expectedSeconds ?? 0) > 1)
    #expect((plan.memoryBytes ?? 0) > 1 << 30 && (plan.diskBytes ?? 0) > 100_000_000)
    let few = try CommandProcess.run(["two", "m.usdz", "--dry-run"], in: folder)
    #expect(few.exitCode == 1 && few.errors.contains("at least 3"), "\(few.errors)")
    let wrong = try CommandProcess.run(["photos", "no/m.usdz", "--dry-run"], in: folder)
    #expect(wrong.exitCode == 2)
    #expect(
      try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted() == [
        "photos", "two",
      ])
  }

  @Test func inspectListsMasks() throws {
    try temporary.writeNoisePhotos(3, to: "photos")
    let mask = RasterImage(width: 400, height: 300, channels: 1, filledWith: 255)
    try temporary.write(ImageCodec.encodePNG(mask), as: "photos/p0_mask.png")
    let black = RasterImage(width: 800, height: 600, channels: 1)
    try temporary.write(ImageCodec.encodePNG(black), as: "photos/p1_mask.png")
    let run = try CommandProcess.run(["inspect", "photos"], in: folder)
    #expect(run.exitCode == 0)
    #expect(run.output.contains("mask 100 %"))
    #expect(run.output.contains("p1_mask.png is not used as a mask: no pixel is marked"))
    #expect(run.output.contains("1 of 3 photos have a mask."))
    let missing = try CommandProcess.run(["inspect", "photos", "--masks", "none"], in: folder)
    #expect(missing.exitCode == 2)
    #expect(missing.errors.contains("none"))
  }

  @Test func jsonIsTheOnlyOutput() throws {
    try temporary.writeNoisePhotos(2, to: "two")
    try temporary.write("hello", as: "two/notes.txt")
    let run = try CommandProcess.run(["two", "m.usdz", "--json", "--verbose"], in: folder)
    #expect(run.exitCode == 1)
    let events = run.output.split(separator: "\n").map { RunEvent(line: $0.utf8) }
    #expect(!events.contains(nil), "\(run.output)")
    let refused = events.compactMap(\.self).filter { $0.event == "invalidSample" }
    #expect(refused.count == 1 && refused[0].reason?.contains("notes.txt") == true)
    #expect(!run.output.contains(#""event":"warning""#))
    #expect(events.last??.event == "failed" && events.last??.isTransient == false)
    #expect(events.last??.message?.contains("at least 3") == true)
    let missing = try CommandProcess.run(["no", "m.usdz", "--json"], in: folder)
    #expect(missing.exitCode == 2)
    #expect(RunEvent(line: missing.output.utf8)?.message?.contains("does not exist") == true)
  }
}
