import Foundation
import Pipeline
import SharedCommands
import TestLevels
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct ReportFileTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var folder: URL { temporary.url }

  private static let schema = URL(fileURLWithPath: #filePath).deletingLastPathComponent()
    .appendingPathComponent("../../../../docs/report.schema.json").standardizedFileURL

  private func report(_ name: String) throws -> Data {
    try Data(contentsOf: folder.appendingPathComponent(name))
  }

  /// The text of the script element with an ID in a page.
  private func script(_ id: String, in page: String) throws -> Data {
    let text = String(decoding: try report(page), as: UTF8.self)
    let start = try #require(text.range(of: "id=\"\(id)\">"))
    let end = try #require(text[start.upperBound...].range(of: "</script>"))
    return Data(text[start.upperBound..<end.lowerBound].utf8)
  }

  @Test func namesDecideTheForm() throws {
    for name in ["r.html", "r.HTM"] {
      #expect(try ReportFile(folder.path + "/" + name).isPage)
    }
    for name in ["r.json", "r", "html"] {
      #expect(try !ReportFile(folder.path + "/" + name).isPage)
    }
    #expect(throws: CommandFailure.self) { try ReportFile(folder.path + "/no/r.html") }
  }

  @Test(.endToEnd) func reportsOfRunsHaveTheDocumentedFormat() throws {
    let photos = Fixtures.images(of: "orbit").path
    let run = try CommandProcess.run(
      [photos, "m.glb", "-d", "preview", "--report", "whole.json"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    let schema = try JSONSchema(Self.schema)
    #expect(try schema.faults(in: report("whole.json")) == [])
    let whole = try JSONDecoder().decode(RunReport.self, from: report("whole.json"))
    #expect(whole.verdict?.level == .good && whole.photos.count == 20)
    #expect(whole.photos.allSatisfy { $0.position != nil && ($0.textureShare ?? 0) > 0 })
    let shares = whole.photos.compactMap(\.textureShare).reduce(0, +)
    #expect(abs(shares + (whole.surface?.closedShare ?? 0) - 1) < 1e-3)
    #expect(whole.memory.bytes.count > 2 && whole.memory.bytes.count == whole.memory.seconds.count)
    #expect(whole.run?.command.contains("whole.json") == true && whole.run?.output == "m.glb")
    #expect(whole.advice.contains { $0.kind == .surface && $0.sentence.contains("underside") })
  }

  /// Nine neighbors of the lower ring: the other five, and the upper ring, are missing.
  @Test(.endToEnd) func adviceNamesThePhotosBesideAGap() throws {
    let target = folder.appendingPathComponent("photos", isDirectory: true)
    try FileManager.default.createDirectory(at: target, withIntermediateDirectories: true)
    for number in 3...11 {
      let name = "view_\(number < 10 ? "0" : "")\(number).jpg"
      try FileManager.default.copyItem(
        at: Fixtures.images(of: "orbit").appendingPathComponent(name),
        to: target.appendingPathComponent(name))
    }
    let run = try CommandProcess.run(
      ["photos", "m.glb", "-d", "preview", "--report", "gap.json"], in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    let gap = try JSONDecoder().decode(RunReport.self, from: report("gap.json")).assessed
    let advice = try #require(gap.advice.first)
    #expect(gap.verdict?.level != .good)
    #expect(
      advice.sentence.contains("view_11.jpg and view_03.jpg")
        || advice.sentence.contains("view_03.jpg and view_11.jpg"), "\(advice.sentence)")
    // The places are on the side without photos.
    let positions = gap.photos.compactMap(\.position)
    let middle = positions.reduce(.zero, +) / Double(positions.count)
    #expect(!advice.places.isEmpty)
    for place in advice.places {
      let (taken, wanted) = (middle - place.target, place.position - place.target)
      #expect(taken.x * wanted.x + taken.z * wanted.z < 0)
    }
  }

  @Test(.endToEnd) func runsThatFailHaveReports() throws {
    try temporary.writeNoisePhotos(3, to: "photos")
    try temporary.write("This is no photo.", as: "photos/text.jpg")
    let run = try CommandProcess.run(
      ["photos", "m.glb", "--report", "failed.html"], in: folder)
    #expect(run.exitCode == 1)
    let json = try script("report", in: "failed.html")
    #expect(try JSONSchema(Self.schema).faults(in: json) == [])
    let failed = try JSONDecoder().decode(RunReport.self, from: json)
    #expect(failed.verdict?.level == .failed)
    #expect(failed.matches?.pairs.features.count == 3)
    #expect(
      failed.photos.first { $0.name == "text.jpg" }?.reason?.contains("is not used") == true)
  }

  @Test(.endToEnd) func photosAreReportedBeforeARun() throws {
    let run = try CommandProcess.run(
      ["inspect", Fixtures.images(of: "orbit").path, "--overlap", "--report", "before.json"],
      in: folder)
    #expect(run.exitCode == 0, "\(run.errors)")
    #expect(try JSONSchema(Self.schema).faults(in: report("before.json")) == [])
    let before = try JSONDecoder().decode(RunReport.self, from: report("before.json"))
    #expect(before.verdict?.sentence == "All 20 photos can be used.")
    #expect(before.matches?.pairs.groups.count == 1)
  }

  @Test func aReportAndAViewerNeedTwoNames() throws {
    try temporary.writeNoisePhotos(1, to: "photos")
    try CommandProcess.expectFailure(
      ["photos", "m.glb", "--report", "m.html", "--viewer"], in: folder, code: 2,
      mentioning: ["m.html", "another name"])
  }
}
