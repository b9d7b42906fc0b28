import Foundation

/// The reason why a command ends without its result: a sentence for the user, and an exit code.
package struct CommandFailure: Error, Equatable {
  /// Exit code of a run that failed.
  package static let runCode: Int32 = 1
  /// Exit code of invalid arguments or paths.
  package static let usageCode: Int32 = 2
  /// Exit code of a batch with a result that is worse than that of its baseline.
  package static let regressionCode: Int32 = 3
  /// Exit code after an interrupt, as shells report SIGINT.
  package static let interruptedCode: Int32 = 130

  /// The cause, and the remedy if there is one.
  package var sentence: String
  /// The exit code of the process.
  package var exitCode: Int32
  /// Whether another attempt may succeed.
  package var isTransient = false

  /// Whether a signal or the end of standard input ended the command.
  package var isInterrupt: Bool { exitCode == Self.interruptedCode }

  /// The run failed.
  package static func run(_ sentence: String, isTransient: Bool = false) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: runCode, isTransient: isTransient)
  }

  /// The arguments are invalid, or a path that they name can't be used.
  package static func usage(_ sentence: String) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: usageCode)
  }

  /// All results were written, but some are worse than those of a baseline.
  package static func regression(_ sentence: String) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: regressionCode)
  }

  /// A signal ended the command before its result was written.
  package static func interrupted(_ sentence: String) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: interruptedCode)
  }
}

extension CommandFailure {
  /// The failure of a run by `error`: its description and recovery suggestion. A `CommandFailure`
  /// is returned unchanged.
  package init(_ error: any Error, isTransient: Bool = false) {
    self =
      error as? CommandFailure
      ?? .run(Self.sentence(for: error), isTransient: isTransient)
  }

  private static func sentence(for error: any Error) -> String {
    let description = error.localizedDescription
    guard let remedy = (error as? any LocalizedError)?.recoverySuggestion,
      !remedy.isEmpty, !description.contains(remedy)
    else { return description }
    return "\(description) \(remedy)"
  }
}
