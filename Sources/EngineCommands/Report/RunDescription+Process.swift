import Foundation
import Pipeline
import RealityFoundation
import SceneModel

extension RunDescription {
  /// This process, which made a model of `photos`. It began as long ago as the report says.
  init(_ report: RunReport, photos: URL, output: URL?) {
    let seconds = report.stages.map { $0.start + $0.seconds }.max() ?? 0
    self.init(
      command: ["photogrammetry-cli"] + CommandLine.arguments.dropFirst(),
      program: ProgramVersion.current,
      started: Date(timeIntervalSinceNow: -seconds).formatted(.iso8601), seconds: seconds,
      name: Self.name(of: photos.resolvingSymlinksInPath()), output: output?.lastPathComponent,
      system: SystemDescription.name, processor: SystemDescription.processor,
      cores: ProcessorShare.current.threads, threads: report.configuration.threadCount,
      memoryBytes: Int(clamping: Machine.current.totalMemoryBytes))
  }

  /// The name of a folder or video; of a folder that is named after its content, that of the folder
  /// around it.
  private static func name(of photos: URL) -> String {
    let name = photos.lastPathComponent
    let around = photos.deletingLastPathComponent().lastPathComponent
    let isPlain = ["images", "photos", "pictures"].contains(name.lowercased())
    return isPlain && !around.isEmpty && around != "/" ? around : name
  }
}
