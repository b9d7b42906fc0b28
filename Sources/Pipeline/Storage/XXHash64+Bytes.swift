import Kernels

extension XXHash64 {
  /// The hash of some bytes, for instance of a file's content.
  static func hash(_ bytes: [UInt8]) -> UInt64 { bytes.withUnsafeBytes { hash($0) } }
}
