import CKernels

extension [UInt8] {
  /// Copies the bytes that a kernel allocated, and frees them; empty for null.
  package init(taking bytes: OpaquePointer?) {
    guard let bytes else {
      self = []
      return
    }
    defer { ck_bytes_free(bytes) }
    let size = ck_bytes_count(bytes)
    self.init(unsafeUninitializedCapacity: size) { buffer, count in
      if let base = buffer.baseAddress, size > 0 { ck_bytes_copy(bytes, base) }
      count = size
    }
  }
}
