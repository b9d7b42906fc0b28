import Foundation

/// Why an option can't be changed.
package enum OptionOverrideError: LocalizedError, Equatable {
  case unknownOption(path: String, choices: [String])
  case wrongValue(path: String, value: String)

  package var errorDescription: String? {
    switch self {
    case .unknownOption(let path, let choices):
      "There is no option \(path). Choose one of: \(choices.joined(separator: ", "))."
    case .wrongValue(let path, let value):
      "\(value) is no value of the option \(path)."
    }
  }
}
