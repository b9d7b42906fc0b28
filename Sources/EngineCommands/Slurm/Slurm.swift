import Foundation
import SharedCommands

/// Slurm's commands on this machine.
struct Slurm: Sendable {
  /// A job, or a task of a job array, that waits or runs.
  struct Job: Equatable, Sendable {
    /// The job's name.
    var name: String
    /// Without the number of the task.
    var id: String
    /// The number in the array; nil if it is not one of several.
    var task: Int?
    /// Such as `PENDING` or `RUNNING`.
    var state: String
    /// The machine that it runs on.
    var node: String
    /// Why it waits.
    var reason: String

    var isRunning: Bool { state == "RUNNING" || state == "COMPLETING" }
  }

  /// How a job ended, as the controller remembers it for some minutes.
  struct End: Equatable, Sendable {
    /// Such as `OUT_OF_MEMORY` or `NODE_FAIL`.
    var state: String
    /// The exit code and the signal, such as `0:9`.
    var exitCode: String
    var node: String
  }

  private let folder: URL

  /// Throws a `CommandFailure` if Slurm is not installed.
  init() throws {
    guard let path = ExternalCommand.path(of: "sbatch") else {
      throw CommandFailure.usage(
        "sbatch is not in the PATH of this machine. Run the command on a machine that submits jobs "
          + "to Slurm, or omit --slurm.")
    }
    folder = URL(fileURLWithPath: path).deletingLastPathComponent()
  }

  /// Submits a script, and returns the job's ID. Throws a `CommandFailure` with Slurm's reason.
  func submit(_ script: String, _ options: [String]) throws -> String {
    let output = try run("sbatch", ["--parsable"] + options, input: script)
    // With several clusters, the name of the cluster follows.
    let id = output.trimmed.prefix { $0 != ";" }
    guard !id.isEmpty, id.allSatisfy(\.isNumber) else {
      throw CommandFailure.run("sbatch printed no job ID: \(output.trimmed)", isTransient: true)
    }
    return String(id)
  }

  /// The jobs of this user with the given names that wait or run. Throws a transient
  /// `CommandFailure` if the controller does not answer.
  func jobs(named names: [String]) throws -> [Job] {
    guard !names.isEmpty else { return [] }
    let output = try run(
      "squeue",
      [
        "--noheader", "--array", "--user=\(NSUserName())", "--name=\(names.joined(separator: ","))",
        "--format=%j|%F|%K|%T|%N|%r",
      ])
    return output.split(separator: "\n").compactMap(Self.job)
  }

  /// Parses a line of `squeue`; nil if it has another form.
  static func job(_ line: Substring) -> Job? {
    let fields = line.split(separator: "|", omittingEmptySubsequences: false).map(String.init)
    guard fields.count >= 6 else { return nil }
    return Job(
      name: fields[0], id: fields[1], task: Int(fields[2]), state: fields[3], node: fields[4],
      reason: fields[5])
  }

  /// How a job ended; nil if the controller does not remember it.
  func end(of job: String, task: Int?) -> End? {
    let id = task.map { "\(job)_\($0)" } ?? job
    let output = try? run("scontrol", ["--oneliner", "show", "job", id])
    return output.flatMap(Self.end)
  }

  /// Parses the output of `scontrol show job`; nil if it has another form.
  static func end(_ text: String) -> End? {
    let line = text.split(separator: "\n").first ?? ""
    var fields: [Substring: String] = [:]
    for word in line.split(separator: " ") {
      let parts = word.split(separator: "=", maxSplits: 1)
      if parts.count == 2 { fields[parts[0]] = String(parts[1]) }
    }
    guard let state = fields["JobState"] else { return nil }
    return End(
      state: state, exitCode: fields["ExitCode"] ?? "", node: fields["NodeList"] ?? "")
  }

  /// Cancels the jobs of this user with the given names.
  func cancel(named names: [String]) throws {
    for name in names { _ = try run("scancel", ["--user=\(NSUserName())", "--name=\(name)"]) }
  }

  /// The largest number of processors of a node; nil if it is not known.
  func processorsPerNode(partition: String?) -> Int? { largest("%c", partition) }

  /// The memory of the largest node in megabytes; nil if it is not known.
  func megabytesPerNode(partition: String?) -> Int? { largest("%m", partition) }

  /// The largest number that `sinfo` prints of a field.
  private func largest(_ field: String, _ partition: String?) -> Int? {
    let choice = partition.map { ["--partition=\($0)"] } ?? []
    let output = try? run("sinfo", ["--noheader", "--format=\(field)"] + choice)
    return output?.split(separator: "\n").compactMap { Int($0.filter(\.isNumber)) }.max()
  }

  /// The standard output of a command; throws a transient `CommandFailure` if it fails.
  private func run(_ name: String, _ arguments: [String], input: String = "") throws -> String {
    let result: ExternalCommand
    do {
      result = try ExternalCommand.run(
        folder.appendingPathComponent(name).path, arguments, input: input)
    } catch {
      throw CommandFailure.run("\(name) could not be started: \(error.localizedDescription)")
    }
    guard result.exitCode == 0 else {
      throw CommandFailure.run(
        "\(name) failed: \(result.errors.trimmed)",
        isTransient: Self.passingErrors.contains { result.errors.contains($0) })
    }
    return result.output
  }

  /// What Slurm prints while its controller is away or busy.
  private static let passingErrors = [
    "contact slurm controller", "timed out", "temporarily", "Connection refused",
  ]
}

extension String {
  /// Without white space at both ends.
  fileprivate var trimmed: String { trimmingCharacters(in: .whitespacesAndNewlines) }
}
