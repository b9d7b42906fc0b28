import Foundation
import SharedCommands

/// The result of one attempt at a dataset.
struct BatchResult: Equatable {
  var status: DatasetStatus
  /// The event `complete`, with the number of photos and triangles.
  var counts: RunEvent?
  var error: String?
  /// Whether another attempt may succeed.
  var isTransient = false

  /// Reads the last line of the file `log` if a run ended without a final event.
  init(_ outcome: ChildRun.Outcome, log: URL) {
    status = .failed
    switch outcome {
    case .ended(0, let last?) where last.event == "complete":
      (status, counts) = (.done, last)
    case .ended(CommandFailure.interruptedCode, _):
      (status, error) = (.cancelled, BatchSummary.resumeHint)
    case .ended(_, let last?) where last.event == "failed":
      (error, isTransient) = (last.message, last.isTransient ?? false)
    case .ended(let code, _):
      let reason = Self.lastLine(of: log).map { ": \($0)" } ?? "."
      error = "The run ended with code \(code); see \(log.path)\(reason)"
      // Except for invalid arguments the cause is unknown and may be transient.
      isTransient = code != CommandFailure.usageCode
    case .killed(let signal):
      (error, isTransient) = (Self.sentence(forSignal: signal, log: log), true)
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

extension BatchEntry {
  /// Records the result of an attempt.
  mutating func record(_ result: BatchResult, seconds: Double) {
    status = result.status
    attempts += 1
    self.seconds += seconds
    error = result.error
    if let counts = result.counts {
      photos = counts.photos ?? photos
      (registered, triangles) = (counts.registered, counts.triangles)
      quality = counts.quality
    }
  }
}
