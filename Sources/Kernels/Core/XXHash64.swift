import CKernels

/// XXH64 by Y. Collet: a hash that is stable across runs and machines, at memory speed. Detects
/// changed bytes, not forged ones.
package enum XXHash64 {
  /// The hash of `bytes`.
  package static func hash(_ bytes: UnsafeRawBufferPointer, seed: UInt64 = 0) -> UInt64 {
    ck_hash(bytes.baseAddress, bytes.count, seed)
  }

  /// The hash of `bytes` with seed 0.
  package static func hash(_ bytes: [UInt8]) -> UInt64 { bytes.withUnsafeBytes { hash($0) } }
}
