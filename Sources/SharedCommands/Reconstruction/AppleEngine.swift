import ArgumentParser
import Formats
import Foundation

/// Apple's engine: nothing beyond the public API of RealityKit.
package enum AppleEngine: EngineSupport {
  package struct Arguments: EngineArguments {
    package init() {}

    package func check(_ output: ModelOutput, _ detail: DetailArguments) throws {}
    package func outputs(with model: ModelOutput) throws -> EngineOutputs { EngineOutputs() }
    package func configure(_ session: PhotogrammetrySession, photos: URL) throws {}
    package func files(
      of session: PhotogrammetrySession, photos: URL, model: ModelOutput
    ) throws -> [EngineFile] { [] }
  }

  package static var commands: [any ParsableCommand.Type] { [] }
  package static let modelFormats = [ModelFormat.usdz]
  package static let sessionOutputSource: String? = nil

  package static var help: EngineHelp {
    var help = EngineHelp()
    help.outputs = """
      OUTPUT
        model.usdz  for AR Quick Look
        model/      folder with OBJ, MTL, USDA and textures

      """
    return help
  }

  package static var unsupportedMachine: CommandFailure {
    .run("Object Capture does not support this Mac. Use a Mac with Apple silicon.")
  }

  package static let versions =
    "RealityKit of macOS \(ProcessInfo.processInfo.operatingSystemVersionString)"

  package static func input(_ path: String) throws -> PhotoInput {
    .folder(try PhotoFolderArgument(path).url)
  }

  package static func photos(
    of video: URL, _ arguments: ReconstructArguments<Arguments>, _ reporter: RunReporter
  ) throws -> InputPhotos { InputPhotos(video) }

  package static func prepareProcess() {}

  package static func isTransient(_ error: any Error) -> Bool { false }

  package static func intrinsics(
    of pose: PhotogrammetrySession.Pose
  ) -> PosesFile.Intrinsics? { nil }

  package static func addCounts(of session: PhotogrammetrySession, to event: inout RunEvent) {}

  package static func concerns(about session: PhotogrammetrySession) -> [String] { [] }

  package static func runInstead(
    _ arguments: ReconstructArguments<Arguments>, photos: URL, output: ModelOutput,
    _ reporter: RunReporter
  ) async throws -> Bool { false }
}
