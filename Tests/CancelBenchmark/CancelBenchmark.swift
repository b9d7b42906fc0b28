import ArgumentParser
import Foundation
import RealityFoundation
import SceneModel

/// Cancels sessions at random times and reports how quickly they end. Then completes each run and
/// compares its model with that of an uninterrupted session. Fails if they differ or if a session
/// ends in an unexpected way.
@main
struct CancelBenchmark: AsyncParsableCommand {
  static let configuration = CommandConfiguration(commandName: "cancel-benchmark")

  @Argument(help: "The folder with the photos.")
  var photos: String

  @Option(help: "The number of cancellations.")
  var cancels = 100

  @Option(help: "The seed of the random times.")
  var seed: UInt64 = 1

  @Option(help: "preview, reduced, medium, full or raw.")
  var detail = Detail.preview

  enum Detail: String, ExpressibleByArgument {
    case preview, reduced, medium, full, raw

    var value: PhotogrammetrySession.Request.Detail {
      switch self {
      case .preview: .preview
      case .reduced: .reduced
      case .medium: .medium
      case .full: .full
      case .raw: .raw
      }
    }
  }

  func run() async throws {
    let folder = FileManager.default.temporaryDirectory
      .appendingPathComponent("cancel-benchmark-\(ProcessInfo.processInfo.processIdentifier)")
    defer { try? FileManager.default.removeItem(at: folder) }
    try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    var trial = CancelTrial(
      photos: URL(fileURLWithPath: photos, isDirectory: true), detail: detail.value, folder: folder,
      generator: SplitMix64(seed: seed))
    try await trial.makeReference()
    while trial.count < cancels {
      try await trial.makeWithCancellations(atMost: cancels - trial.count)
    }
    trial.printSummary()
  }
}
