import Foundation

extension Data {
  /// The bytes of some values, in native byte order.
  init(bytesOf values: [some BitwiseCopyable]) {
    self = values.withUnsafeBytes { Data($0) }
  }

  /// The values whose bytes these are; what remains is left out.
  func values<Value: BitwiseCopyable>(of type: Value.Type) -> [Value] {
    withUnsafeBytes { bytes in
      (0..<bytes.count / MemoryLayout<Value>.stride).map {
        bytes.loadUnaligned(fromByteOffset: $0 * MemoryLayout<Value>.stride, as: type)
      }
    }
  }
}
