import Formats
import Foundation
import SharedCommands

/// The files in the folder of a plan that only Slurm needs.
///
/// ```
/// slurm/settings.json       options of all jobs
/// slurm/1234.json           the chunks of a job array
/// ```
struct SlurmFolder: Sendable {
  let url: URL

  /// Creates the folder if it is missing; throws `OutputError`.
  init(of plan: PlanFolder) throws {
    url = plan.url.appendingPathComponent("slurm", isDirectory: true)
    do {
      try FileManager.default.createDirectory(at: url, withIntermediateDirectories: true)
    } catch {
      throw OutputError.notWritable(path: url.path)
    }
  }

  private var settingsFile: URL { url.appendingPathComponent("settings.json") }

  func write(_ settings: SlurmSettings) throws {
    try AtomicFile.write(try JSONEncoder.readable.encode(settings), to: settingsFile)
  }

  /// Throws a `CommandFailure` if the plan was not submitted to Slurm.
  func settings() throws -> SlurmSettings {
    guard let data = FileManager.default.contents(atPath: settingsFile.path),
      let settings = try? JSONDecoder().decode(SlurmSettings.self, from: data)
    else {
      throw CommandFailure.usage(
        "\(url.relativePath) has no settings.json: this plan was not submitted to Slurm. Repeat "
          + "the command that made the plan, with --slurm.")
    }
    return settings
  }

  func write(_ submission: SlurmSubmission) throws {
    try AtomicFile.write(
      try JSONEncoder.readable.encode(submission),
      to: url.appendingPathComponent("\(submission.job).json"))
  }

  /// All submissions since the plan was last started by a user, the oldest first.
  func submissions() -> [SlurmSubmission] {
    files.compactMap { FileManager.default.contents(atPath: $0.path) }
      .compactMap { try? JSONDecoder().decode(SlurmSubmission.self, from: $0) }
      .sorted { ($0.order, $0.job) < ($1.order, $1.job) }
  }

  /// Forgets all submissions: a user who repeats the command wants failed chunks made again.
  func forgetSubmissions() {
    for file in files { try? FileManager.default.removeItem(at: file) }
  }

  private var files: [URL] {
    ((try? FileManager.default.contentsOfDirectory(atPath: url.path)) ?? [])
      .filter { $0.hasSuffix(".json") && $0 != "settings.json" && !$0.hasPrefix(".") }
      .map { url.appendingPathComponent($0) }
  }
}
