import Foundation
import Kernels

extension Fingerprint {
  /// The canonical encoding of a value: equal values give equal bytes.
  static func content(of value: some Encodable) throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = .sortedKeys
    return try encoder.encode(value)
  }
}
