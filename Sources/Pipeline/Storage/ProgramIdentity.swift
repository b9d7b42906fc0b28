import Foundation
import Kernels

/// Distinguishes builds of the program whose results may differ.
package enum ProgramIdentity {
  /// The hash of the executable's content, so that any change of the code counts.
  package static let fingerprint = fingerprint(
    ofExecutable: Bundle.main.executablePath ?? "/proc/self/exe")

  /// The hash of a file's content. One that can't be read equals no other program: the number is
  /// random, so that no later run reuses the results.
  static func fingerprint(ofExecutable path: String) -> UInt64 {
    let content = try? Data(contentsOf: URL(fileURLWithPath: path), options: .alwaysMapped)
    return content?.withUnsafeBytes { XXHash64.hash($0) } ?? .random(in: .min ... .max)
  }
}
