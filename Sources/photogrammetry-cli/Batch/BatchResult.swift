#if canImport(Pipeline)
  import Foundation

  /// What came of one attempt at a dataset.
  struct BatchResult: Equatable {
    var status: BatchEntry.Status
    var counts: RunEvent?
    var error: String?
    /// Whether another attempt may succeed.
    var mayPass = false

    /// Reads the file `log` where a run ended without saying why.
    init(_ outcome: ChildRun.Outcome, log: URL) {
      status = .failed
      switch outcome {
      case .ended(0, let last?) where last.event == "complete":
        (status, counts) = (.done, last)
      case .ended(CommandFailure.interruptedCode, _):
        (status, error) = (.cancelled, "Interrupted; run the same command again to go on.")
      case .ended(_, let last?) where last.event == "failed":
        (error, mayPass) = (last.message, last.mayPass ?? false)
      case .ended(let code, _):
        let reason = Self.lastLine(of: log).map { ": \($0)" } ?? "."
        error = "The run ended with code \(code)\(reason)"
        // Other causes than a wrong command line are unknown, so they may pass.
        mayPass = code != CommandFailure.usageCode
      case .killed(let signal):
        (error, mayPass) = (Self.sentence(forSignal: signal), true)
      case .notStarted(let reason):
        (error, mayPass) = ("The run could not be started: \(reason)", true)
      }
    }

    private static func sentence(forSignal signal: Int32) -> String {
      signal == SIGKILL
        ? "The run was killed (signal 9), as happens where memory runs out. Use fewer --jobs or a "
          + "lower detail level."
        : "The run crashed (signal \(signal)). Try another detail level, and report the error."
    }

    private static func lastLine(of file: URL) -> String? {
      guard let data = FileManager.default.contents(atPath: file.path) else { return nil }
      return String(decoding: data, as: UTF8.self).split(whereSeparator: \.isNewline).last
        .map(String.init)
    }
  }

  extension BatchEntry {
    /// Takes in what came of an attempt.
    mutating func take(_ result: BatchResult, seconds: Double) {
      status = result.status
      attempts += 1
      self.seconds += seconds
      error = result.error
      if let counts = result.counts {
        photos = counts.photos ?? photos
        (registered, triangles) = (counts.registered, counts.triangles)
      }
    }
  }
#endif
