/// Memory for the rows of an image, at a fixed address as long as the object lives.
package final class PixelStorage {
  /// The size in bytes.
  package let byteCount: Int
  private let bytes: UnsafeMutableRawBufferPointer
  /// Whether the memory is freed with the object.
  private let isOwner: Bool

  /// Allocates zeroed memory.
  package init(byteCount: Int) {
    isOwner = true
    self.byteCount = max(0, byteCount)
    bytes = .allocate(byteCount: self.byteCount, alignment: 64)
    bytes.initializeMemory(as: UInt8.self, repeating: 0)
  }

  /// Wraps existing memory, which must outlive the object.
  package init(borrowing baseAddress: UnsafeMutableRawPointer, byteCount: Int) {
    isOwner = false
    self.byteCount = max(0, byteCount)
    bytes = UnsafeMutableRawBufferPointer(start: baseAddress, count: self.byteCount)
  }

  deinit { if isOwner { bytes.deallocate() } }

  /// The first byte; valid for as long as the object lives.
  package var baseAddress: UnsafeMutableRawPointer? { bytes.baseAddress }

  /// A copy of the bytes in the range, clamped to the available bytes.
  package func copy(_ range: Range<Int>) -> [UInt8] {
    Array(bytes[range.clamped(to: 0..<byteCount)])
  }

  /// Writes bytes starting at an offset; bytes that don't fit are dropped.
  package func write(_ source: [UInt8], at offset: Int) {
    guard (0..<byteCount).contains(offset) else { return }
    let count = min(source.count, byteCount - offset)
    UnsafeMutableRawBufferPointer(rebasing: bytes[offset..<offset + count])
      .copyBytes(from: source.prefix(count))
  }
}
