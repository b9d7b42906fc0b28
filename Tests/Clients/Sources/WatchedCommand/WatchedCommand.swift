import ArgumentParser
import Foundation
import RealityKit

extension PhotogrammetrySession.Request.Detail: @retroactive ExpressibleByArgument {
  /// Parses the name of a case.
  public init?(argument: String) {
    switch argument.lowercased() {
    case "preview": self = .preview
    case "reduced": self = .reduced
    case "medium": self = .medium
    case "full": self = .full
    case "raw": self = .raw
    case "custom": self = .custom
    default: return nil
    }
  }
}

extension PhotogrammetrySession.Configuration.FeatureSensitivity: @retroactive ExpressibleByArgument
{
  /// Parses the name of a case.
  public init?(argument: String) {
    guard let match = ["normal": Self.normal, "high": .high][argument] else { return nil }
    self = match
  }
}

@main
struct WatchedCommand: AsyncParsableCommand {
  @Argument(
    help: "The photos.", completion: .directory,
    transform: { URL(fileURLWithPath: $0, isDirectory: true) })
  var input: URL

  @Argument(help: "The folder for the models.") var output: String

  @Option(name: .shortAndLong) var details: [PhotogrammetrySession.Request.Detail] = [.preview]

  @Option var featureSensitivity: PhotogrammetrySession.Configuration.FeatureSensitivity = .normal

  @Option(help: "Seconds until the session is canceled.") var timeout: Double = 600

  func run() async throws {
    let folder = URL(fileURLWithPath: (output as NSString).standardizingPath, isDirectory: true)
    try FileManager.default.createDirectory(at: folder, withIntermediateDirectories: true)
    var configuration = PhotogrammetrySession.Configuration()
    configuration.featureSensitivity = featureSensitivity
    let runner = try SessionRunner(input: input, configuration: configuration)
    var last = 0.0
    runner.onProgress = { last = max(last, $0) }
    let interrupts = DispatchSource.makeSignalSource(signal: SIGINT, queue: .main)
    interrupts.setEventHandler { Foundation.exit(130) }
    interrupts.resume()
    do {
      try await runner.run([.poses, .bounds], timeout: timeout)
      let upper = BoundingBox(
        min: SIMD3(runner.box.min.x, runner.box.center.y, runner.box.min.z),
        max: runner.box.max)
      let models = details.map { detail in
        PhotogrammetrySession.Request.modelFile(
          url: folder.appendingPathComponent("\(detail).usdz"), detail: detail,
          geometry: .init(bounds: upper))
      }
      try await runner.run(models, timeout: timeout)
    } catch {
      print("failed: \(error)")
      throw ExitCode(3)
    }
    let frames = autoreleasepool {
      runner.posesByID.sorted { $0.key < $1.key }.map { Frame(id: $0.key, transform: $0.value) }
    }
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys]
    try encoder.encode(frames).write(to: folder.appendingPathComponent("poses.json"))
    print("\(frames.count) poses, progress \(last), size \(runner.box.extents)")
  }
}
