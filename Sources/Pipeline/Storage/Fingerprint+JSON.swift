import Foundation
import Kernels

extension Fingerprint {
  /// A value as bytes that are the same whenever the value is.
  static func content(of value: some Encodable) throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = .sortedKeys
    return try encoder.encode(value)
  }
}
