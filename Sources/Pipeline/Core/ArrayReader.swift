/// Reads consecutive arrays; the caller has checked the bounds.
struct ArrayReader {
  let bytes: UnsafeRawBufferPointer
  var offset: Int

  mutating func array<Element: BitwiseCopyable>(_ count: Int, of type: Element.Type) -> [Element] {
    defer { offset += count * MemoryLayout<Element>.stride }
    let source = UnsafeRawBufferPointer(
      rebasing: bytes[offset..<offset + count * MemoryLayout<Element>.stride])
    return [Element](unsafeUninitializedCapacity: count) { buffer, initialized in
      UnsafeMutableRawBufferPointer(buffer).copyMemory(from: source)
      initialized = count
    }
  }
}
