import Foundation
import Kernels
import Pipeline
import SharedCommands
import Testing

@testable import EngineCommands
@testable import RealityFoundation

@Suite struct PipelineEngineTests {
  @Test func optionsReachTheArguments() throws {
    let arguments = try PipelineArguments.parse([
      "--preview", "p.png", "--keep-gaps", "--refine", "--masks", "m", "--report", "r.json",
      "--threads", "2", "--measurements", "d.json", "--dry-run",
    ])
    #expect(arguments.preview.preview == "p.png")
    #expect(arguments.surface.keepGaps && arguments.surface.refine)
    #expect(arguments.masking.masks == "m")
    #expect(
      arguments.runArguments.report == "r.json" && arguments.runArguments.threading.threads == 2)
    #expect(arguments.scale.measurements == "d.json" && arguments.isDryRun)
    #expect(try !PipelineArguments.parse([]).isDryRun)
  }

  @Test func onlySomeErrorsAreTransient() {
    #expect(PipelineEngine.isTransient(KernelError.outOfMemory))
    let codes: [ProcessingError.Code] = [
      .outOfMemory, .checkpointUnusable, .tooFewPhotos, .alignmentFailed, .invalidInput,
    ]
    #expect(
      codes.map {
        PipelineEngine.isTransient(ProcessingError(code: $0, reason: "", remedy: ""))
      } == [true, true, false, false, false])
    #expect(!PipelineEngine.isTransient(CommandFailure.run("")))
    #expect(CommandFailure(engineError: KernelError.outOfMemory).isTransient)
  }

  @Test func allFormatsAreWritten() throws {
    for name in ["/tmp/m.usdz", "/tmp/m.glb", "/tmp/m.ply"] {
      #expect(
        try ModelOutput(name, formats: PipelineEngine.modelFormats).format != .folder, "\(name)")
    }
  }
}
