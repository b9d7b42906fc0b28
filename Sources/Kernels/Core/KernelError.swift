import Foundation
import Synchronization

/// Failure of a kernel, with the kernel's message.
package enum KernelError: LocalizedError, Equatable, CustomStringConvertible {
  /// An argument is out of range, or two arguments contradict each other.
  case invalidArgument(String)
  /// The input is valid but does not determine a result.
  case degenerate(String)
  /// Any other failure: a damaged file, or an error of a library.
  case failed(String)
  /// Memory was insufficient; a later attempt may succeed.
  case outOfMemory
  /// This program was built without a library.
  case leftOut(library: String)

  package var description: String {
    switch self {
    case .invalidArgument(let message): "invalid argument: \(message)"
    case .degenerate(let message), .failed(let message): message
    case .outOfMemory: "out of memory"
    case .leftOut(let library): "this program was built without \(library)"
    }
  }

  package var errorDescription: String? { description }
}
