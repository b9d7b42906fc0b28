import Foundation
import SharedCommands

/// How a `reconstruct` in a separate process ended.
struct ChildResult: Equatable {
  /// What a user can do about an interrupted run or batch.
  static let resumeHint = "Interrupted; run the same command again to resume."

  var status: DatasetStatus
  /// The event `complete`, with the number of photos and triangles.
  var counts: RunEvent?
  var error: String?
  /// Whether another attempt may succeed.
  var isTransient = false
  /// Whether another attempt needs more memory.
  var isShortOfMemory = false

  /// Reads the last line of the file `log` if a run ended without a final event.
  init(_ outcome: ChildRun.Outcome, log: URL) {
    status = .failed
    switch outcome {
    case .ended(0, let last?) where last.event == "complete":
      (status, counts) = (.done, last)
    case .ended(CommandFailure.interruptedCode, _):
      (status, error) = (.cancelled, Self.resumeHint)
    case .ended(_, let last?) where last.event == "failed":
      (error, isTransient) = (last.message, last.isTransient ?? false)
      // What passes by itself is nearly always a lack of memory.
      isShortOfMemory = isTransient
    case .ended(let code, _):
      let reason = Self.lastLine(of: log).map { ": \($0)" } ?? "."
      error = "The run ended with code \(code); see \(log.path)\(reason)"
      // Except for invalid arguments the cause is unknown and may be transient.
      isTransient = code != CommandFailure.usageCode
    case .killed(let signal):
      (error, isTransient) = (Self.sentence(forSignal: signal, log: log), true)
      isShortOfMemory = signal == SIGKILL
    case .notStarted(let reason):
      (error, isTransient) = ("The run could not be started: \(reason)", true)
    }
  }

  private static func sentence(forSignal signal: Int32, log: URL) -> String {
    signal == SIGKILL
      ? "The run was killed (signal 9), probably because memory ran out. Use fewer --jobs or a "
        + "lower detail level."
      : "The run crashed (signal \(signal)). Try another detail level, and report the error with "
        + "the log \(log.path)."
  }

  private static func lastLine(of file: URL) -> String? {
    guard let data = FileManager.default.contents(atPath: file.path) else { return nil }
    return String(decoding: data, as: UTF8.self).split(whereSeparator: \.isNewline).last
      .map(String.init)
  }
}
