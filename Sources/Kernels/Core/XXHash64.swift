import CKernels

/// XXH64 by Y. Collet: a hash that is the same in every run and on every machine, at the speed of
/// memory. It tells changed bytes, not forged ones.
package enum XXHash64 {
  /// The hash of `bytes`.
  package static func hash(_ bytes: UnsafeRawBufferPointer, seed: UInt64 = 0) -> UInt64 {
    ck_hash(bytes.baseAddress, bytes.count, seed)
  }
}
