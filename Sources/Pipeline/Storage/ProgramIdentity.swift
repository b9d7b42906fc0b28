import Foundation
import Kernels

/// Distinguishes builds of the program whose results may differ.
enum ProgramIdentity {
  /// The hash of the executable's content, so that any change of the code counts.
  static let fingerprint: UInt64 = {
    let path = Bundle.main.executablePath ?? "/proc/self/exe"
    let content = try? Data(contentsOf: URL(fileURLWithPath: path), options: .alwaysMapped)
    return content?.withUnsafeBytes { XXHash64.hash($0) } ?? 0
  }()
}
