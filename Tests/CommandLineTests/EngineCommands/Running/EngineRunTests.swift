import Foundation
import Pipeline
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct EngineRunTests {
  private struct Fault: Error {}

  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private var report: URL { temporary.url.appendingPathComponent("r.json") }

  private func run(_ report: String) throws -> EngineRun {
    try EngineRun(
      EngineRun.Plan(
        source: .photos(in: Fixtures.images(of: "orbit")),
        stages: [.preProcessing, .imageAlignment], limits: DetailSpecification(.preview)),
      PipelineConfiguration(), try RunArguments.parse(["--report", report]), RunReporter(.quiet))
  }

  private func perform(_ work: (ReconstructionPipeline) throws -> Void) throws {
    // A run makes the process ignore both signals; afterward the tests can be interrupted again.
    defer { for number in [SIGINT, SIGTERM] { signal(number, SIG_DFL) } }
    try run(report.path).perform(missing: "nothing was written", work)
  }

  private func stages() throws -> [String] {
    try JSONDecoder().decode(RunReport.self, from: Data(contentsOf: report)).stages.map(\.name)
  }

  @Test func reportIsWritten() throws {
    try perform { _ = try $0.ingest() }
    #expect(try stages() == ["preProcessing"])
  }

  @Test func reportIsWrittenAfterAFailure() throws {
    #expect(throws: Fault.self) {
      try perform { pipeline in
        _ = try pipeline.ingest()
        throw Fault()
      }
    }
    #expect(try stages() == ["preProcessing"])
  }

  @Test func reportsThatCannotBeWrittenFailFirst() throws {
    #expect(throws: CommandFailure.self) { try run(temporary.url.path + "/none/r.json") }
  }
}
