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
  /// Writes `count` photos of noise into a folder `name`.
  private func makePhotos(_ count: Int, in folder: URL, _ name: String) throws {
    let photos = folder.appendingPathComponent(name)
    try FileManager.default.createDirectory(at: photos, withIntermediateDirectories: true)
    for index in 0..<count {
      let (width, height) = (800, 600)
      let pixels = (0..<(width * height * 3)).map { place in
        let cell = place / 3 % width / 6 + place / 3 / width / 6 * 977 + index * 31
        return UInt8(truncatingIfNeeded: (cell &* 2_654_435_761) >> 11)
      }
      let image = RasterImage(width: width, height: height, channels: 3, pixels: pixels)
      try Data(try ImageCodec.encodeJPEG(image, quality: 0.9)).write(
        to: photos.appendingPathComponent("p\(index).jpg"))
    }
  }

  private func expectFailure(
    _ arguments: [String], in folder: URL, code: Int32, mentioning words: [String]
  ) throws {
    let before = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
    let run = try CommandProcess.run(arguments, in: folder)
    #expect(run.exitCode == code, "\(run.errors)")
    #expect(run.output.isEmpty)
    for word in words { #expect(run.errors.contains(word), "\(run.errors)") }
    let after = try FileManager.default.contentsOfDirectory(atPath: folder.path).sorted()
    #expect(before == after)
  }

  @Test func invalidArgumentsExitWithTwo() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(1, in: folder, "photos")
    try Data("x".utf8).write(to: folder.appendingPathComponent("file"))
    try expectFailure([], in: folder, code: 2, mentioning: ["input-folder"])
    try expectFailure(
      ["photos", "m.usdz", "-d", "huge"], in: folder, code: 2, mentioning: ["huge", "preview"])
    try expectFailure(
      ["nowhere", "m.usdz"], in: folder, code: 2, mentioning: ["nowhere", "does not exist"])
    try expectFailure(
      ["file", "m.usdz"], in: folder, code: 2, mentioning: ["file is a file"])
    try expectFailure(
      ["photos", "m.obj"], in: folder, code: 2, mentioning: [".obj", ".usdz", ".glb", "slash"])
    try expectFailure(
      ["photos", ".usdz"], in: folder, code: 2, mentioning: ["no name"])
    try expectFailure(
      ["photos", "no/such/m.usdz"], in: folder, code: 2, mentioning: ["m.usdz", "mkdir -p"])
    try expectFailure(
      ["photos", "m.usdz", "--poses", "no/p.json"], in: folder, code: 2,
      mentioning: ["p.json", "mkdir -p"])
    try expectFailure(
      ["evaluate", "photos", "--reference", "photos"], in: folder, code: 2,
      mentioning: ["holds no result"])
    _ = temporary
  }

  @Test func runsWithoutResultExitWithOne() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    let files = FileManager.default
    for name in ["empty", "texts"] {
      try files.createDirectory(
        at: folder.appendingPathComponent(name), withIntermediateDirectories: true)
    }
    for index in 0..<3 {
      try Data("hello".utf8).write(to: folder.appendingPathComponent("texts/\(index).txt"))
    }
    try makePhotos(2, in: folder, "two")
    try expectFailure(
      ["empty", "m.usdz"], in: folder, code: 1, mentioning: ["empty", "JPEG, HEIC or PNG"])
    try expectFailure(
      ["texts", "m.usdz"], in: folder, code: 1, mentioning: ["error: ", "JPEG, HEIC or PNG"])
    try expectFailure(["two", "m.usdz"], in: folder, code: 1, mentioning: ["error: ", "2"])
    _ = temporary
  }

  @Test func reportHasTheReasonOfAFailure() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(2, in: folder, "two")
    let align = try CommandProcess.run(
      ["align", "two", "aligned", "--report", "r.json"], in: folder)
    #expect(align.exitCode == 1 && align.output.isEmpty, "\(align.errors)")
    let model = try CommandProcess.run(
      ["two", "m.usdz", "--checkpoint-directory", "made", "--report", "q.json"], in: folder)
    #expect(model.exitCode == 1, "\(model.errors)")
    for name in ["aligned/report.json", "r.json", "made/report.json", "q.json"] {
      let data = try Data(contentsOf: folder.appendingPathComponent(name))
      let report = try JSONDecoder().decode(RunReport.self, from: data)
      #expect(report.errors == [PipelineError.tooFewPhotos(found: 2, needed: 3).errorDescription])
      #expect(report.stages.map(\.name) == ["preProcessing"])
    }
    _ = temporary
  }

  @Test func inspectListsEveryFile() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(3, in: folder, "photos")
    try Data("hello".utf8).write(to: folder.appendingPathComponent("photos/notes.txt"))
    let run = try CommandProcess.run(["inspect", "photos"], in: folder)
    #expect(run.exitCode == 0)
    #expect(run.output.contains("p1.jpg  800 x 600"))
    #expect(run.output.contains("notes.txt is not used"))
    #expect(run.output.contains("3 photos of 1 camera would be used, 1 file not."))
    let json = try CommandProcess.run(["inspect", "photos", "--json"], in: folder)
    let value = try JSONSerialization.jsonObject(with: Data(json.output.utf8))
    let used = (value as? [String: Any])?["used"] as? [[String: Any]]
    #expect(used?.compactMap { $0["name"] as? String } == ["p0.jpg", "p1.jpg", "p2.jpg"])
    _ = temporary
  }

  @Test func dryRunPrintsThePlanOnly() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(3, in: folder, "photos")
    try makePhotos(2, in: folder, "two")
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
    _ = temporary
  }

  @Test func inspectListsMasks() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(3, in: folder, "photos")
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

  @Test(arguments: [
    ["photos", "m.usdz"], ["align", "photos", "work"], ["photos", "m.usdz", "--json"],
  ])
  func terminationExitsWith130(_ arguments: [String]) throws {
    let temporary = try TemporaryFolder()
    try makePhotos(24, in: temporary.url, "photos")
    let run = try CommandProcess.run(arguments + ["--verbose"], in: temporary.url) {
      $0.terminate()
    }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("Interrupted"))
    if arguments.contains("--json") {
      let last = run.output.split(separator: "\n").last.flatMap { RunEvent(line: $0.utf8) }
      #expect(last?.event == "cancelled" && last?.message?.contains("Interrupted") == true)
    }
  }

  @Test func secondInterruptExitsImmediately() throws {
    let temporary = try TemporaryFolder()
    try makePhotos(24, in: temporary.url, "photos")
    let run = try CommandProcess.run(["photos", "m.usdz"], in: temporary.url) { process in
      process.interrupt()
      usleep(1000)
      process.interrupt()
      usleep(1000)
      process.terminate()
    }
    #expect(run.exitCode == 130, "\(run.errors)")
  }

  @Test func jsonIsTheOnlyOutput() throws {
    let temporary = try TemporaryFolder()
    try makePhotos(2, in: temporary.url, "two")
    try temporary.write(Array("hello".utf8), as: "two/notes.txt")
    let run = try CommandProcess.run(["two", "m.usdz", "--json", "--verbose"], in: temporary.url)
    #expect(run.exitCode == 1)
    let events = run.output.split(separator: "\n").map { RunEvent(line: $0.utf8) }
    #expect(!events.contains(nil), "\(run.output)")
    let refused = events.compactMap(\.self).filter { $0.event == "invalidSample" }
    #expect(refused.count == 1 && refused[0].reason?.contains("notes.txt") == true)
    #expect(!run.output.contains(#""event":"warning""#))
    #expect(events.last??.event == "failed" && events.last??.isTransient == false)
    #expect(events.last??.message?.contains("at least 3") == true)
    let missing = try CommandProcess.run(["no", "m.usdz", "--json"], in: temporary.url)
    #expect(missing.exitCode == 2)
    #expect(RunEvent(line: missing.output.utf8)?.message?.contains("does not exist") == true)
  }

  @Test func interruptExitsWith130() throws {
    let temporary = try TemporaryFolder()
    let folder = temporary.url
    try makePhotos(24, in: folder, "photos")
    let run = try CommandProcess.run(["photos", "m.usdz"], in: folder) { $0.interrupt() }
    #expect(run.exitCode == 130, "\(run.errors)")
    #expect(run.errors.contains("Interrupted"))
    let names = try FileManager.default.contentsOfDirectory(atPath: folder.path)
    #expect(names == ["photos"])
    _ = temporary
  }
}
