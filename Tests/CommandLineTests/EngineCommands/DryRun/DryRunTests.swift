import Formats
import Foundation
import Pipeline
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct DryRunTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private func plan(
    _ detail: [String] = [], _ options: [String] = [], model: String = "m.usdz",
    photos: URL = Fixtures.images(of: "orbit")
  ) throws -> DryRun {
    let path = temporary.url.path + "/" + model
    return try DryRun(
      try .parse(["photos", path] + detail + options), photos: photos,
      output: try ModelOutput(path, formats: ModelFormat.files))
  }

  @Test func planNamesModelTimeAndSpace() throws {
    let plan = try plan(["-d", "medium"], ["--threads", "3"])
    #expect(plan.threadCount == 3 && plan.expectedSeconds > 1)
    #expect(plan.memory.needed == 3 << 30)
    #expect(plan.report.used.count == 20)
    let lines = plan.lines.suffix(2)
    #expect(lines.first?.contains("m.usdz would be written: at most 99999 triangles") == true)
    #expect(lines.first?.contains("4096 x 4096") == true)
    #expect(lines.last?.contains("with 3 threads, at most 3221 MB of memory") == true)
  }

  @Test func rejectedFilesComeBeforeThePlan() throws {
    try temporary.write("no photo", as: "photos/a.jpg")
    let photos = temporary.url.appendingPathComponent("photos", isDirectory: true)
    let plan = try plan(photos: photos)
    #expect(plan.events.map(\.event) == ["invalidSample", "plan"])
    #expect(plan.events[0].reason?.contains("a.jpg") == true)
    #expect(plan.events[1].photos == 0 && plan.events[1].diskBytes == plan.space.needed)
    #expect(plan.faults.contains { $0.contains("at least 3") })
  }

  @Test func lackOfMemoryIsAFault() throws {
    let small = Machine(totalMemoryBytes: 1 << 30)
    let faults = try Machine.$override.withValue(small) { try plan().faults }
    #expect(faults.contains { $0.contains("MB of memory") }, "\(faults)")
  }

  @Test func unknownPhotosOfDistancesAreInvalid() {
    #expect(throws: CommandFailure.self) {
      try plan([], ["--camera-distance", "none.jpg,other.jpg=1"])
    }
  }

  @Test func sizeDependsOnTheFormat() {
    let limits = DetailSpecification(.reduced)
    // 49,999 triangles of 60 bytes; three maps of 2048 × 2048 texels, 3 bytes each.
    #expect(limits.modelBytes(in: .ply) == 2_999_940)
    #expect(limits.modelBytes(in: .usdz) == 2_999_940 + 37_748_736)
    let full = DetailSpecification(.full)
    #expect(full.modelBytes(in: .glb) < full.modelBytes(in: .usdz))
  }

  @Test(arguments: ["400000000000000000", "9223372036854775807", "153722867280912930"])
  func anyNumberOfTrianglesCanBeAllowed(count: String) throws {
    let plan = try plan(["-d", "custom", "--max-polygons", count])
    #expect(plan.lines.contains { $0.contains("at most \(count) triangles") })
    #expect(plan.space.needed > 1 << 62)
    #expect(plan.faults.contains { $0.contains("Free some space") })
  }
}
