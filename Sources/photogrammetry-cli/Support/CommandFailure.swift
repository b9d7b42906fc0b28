import Foundation

/// Why a command ends without its result: a sentence for the user, and an exit code.
struct CommandFailure: Error, Equatable {
  /// The run failed.
  static let runCode: Int32 = 1
  /// The command line can't be carried out as it is.
  static let usageCode: Int32 = 2
  /// Interrupted by a signal.
  static let interruptedCode: Int32 = 130

  var sentence: String
  var exitCode: Int32
  /// Whether the cause may be gone at another time.
  var mayPass = false

  /// Something went wrong while working.
  static func run(_ sentence: String, mayPass: Bool = false) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: runCode, mayPass: mayPass)
  }

  /// The command line asks for what can't be.
  static func usage(_ sentence: String) -> CommandFailure {
    CommandFailure(sentence: sentence, exitCode: usageCode)
  }
}

/// What an error says, with its remedy where it has one.
func sentence(for error: any Error) -> String {
  if let failure = error as? CommandFailure { return failure.sentence }
  let description = error.localizedDescription
  guard let remedy = (error as? any LocalizedError)?.recoverySuggestion,
    !remedy.isEmpty, !description.contains(remedy)
  else { return description }
  return "\(description) \(remedy)"
}
