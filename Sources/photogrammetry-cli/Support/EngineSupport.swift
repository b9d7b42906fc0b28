import ArgumentParser
import Foundation
import RealityKit

#if canImport(Pipeline)
  import Pipeline
  import RealityFoundation

  /// What only our engine can do.
  struct EngineArguments: ParsableArguments {
    @Option(
      name: .long,
      help: ArgumentHelp(
        "Write what was done, stage by stage and photo by photo, as JSON.", valueName: "file.json"))
    var report: String?

    @Option(
      name: .long,
      help: ArgumentHelp(
        "Threads to work with; the result is the same for any number. (default: all processors)",
        valueName: "count"))
    var threads: Int?

    func validate() throws {
      if let threads, threads < 1 || threads > 1024 {
        throw ValidationError("--threads must be from 1 to 1024.")
      }
    }

    /// Checks what can be checked before the work begins.
    func checkOutputs() throws {
      if let report { try ModelOutput.checkWritable(URL(fileURLWithPath: report)) }
    }

    func configure(_ session: PhotogrammetrySession) {
      if let threads { session.engineOptions.threadCount = threads }
    }

    /// The run's report as JSON, where there is one.
    func reportData(of session: PhotogrammetrySession) throws -> Data? {
      try session.report?.encoded()
    }
  }

  /// Our session logs what it meets; saying it again would be noise.
  let sessionLogsItsOutputs = true

  func engineIntrinsics(of pose: PhotogrammetrySession.Pose) -> PosesFile.Intrinsics? {
    pose.intrinsics.map { k in
      PosesFile.Intrinsics(
        focalLength: [k.columns.0.x, k.columns.1.y],
        principalPoint: [k.columns.2.x, k.columns.2.y])
    }
  }
#else
  /// Apple's engine has no options beyond its configuration.
  struct EngineArguments: ParsableArguments {
    var report: String? { nil }

    func checkOutputs() throws {}
    func configure(_ session: PhotogrammetrySession) {}
    func reportData(of session: PhotogrammetrySession) throws -> Data? { nil }
  }

  let sessionLogsItsOutputs = false

  func engineIntrinsics(of pose: PhotogrammetrySession.Pose) -> PosesFile.Intrinsics? { nil }
#endif
