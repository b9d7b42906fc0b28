/// Memory for the rows of an image; it stays in place for as long as the object lives.
package final class PixelStorage {
  package let byteCount: Int
  private let bytes: UnsafeMutableRawBufferPointer
  /// Whether the memory goes away with the object.
  private let isOwner: Bool

  /// Takes memory of its own, zeroed.
  package init(byteCount: Int) {
    isOwner = true
    self.byteCount = max(0, byteCount)
    bytes = .allocate(byteCount: self.byteCount, alignment: 64)
    bytes.initializeMemory(as: UInt8.self, repeating: 0)
  }

  /// Uses memory that outlives the object, as it is.
  package init(borrowing baseAddress: UnsafeMutableRawPointer, byteCount: Int) {
    isOwner = false
    self.byteCount = max(0, byteCount)
    bytes = UnsafeMutableRawBufferPointer(start: baseAddress, count: self.byteCount)
  }

  deinit { if isOwner { bytes.deallocate() } }

  /// The first byte; valid for as long as the object lives.
  package var baseAddress: UnsafeMutableRawPointer? { bytes.baseAddress }

  /// A copy of the bytes in the range, clamped to what is there.
  package func copy(_ range: Range<Int>) -> [UInt8] {
    Array(bytes[range.clamped(to: 0..<byteCount)])
  }

  /// Writes bytes from an offset on; what does not fit is left out.
  package func write(_ source: [UInt8], at offset: Int) {
    guard (0..<byteCount).contains(offset) else { return }
    let count = min(source.count, byteCount - offset)
    UnsafeMutableRawBufferPointer(rebasing: bytes[offset..<offset + count])
      .copyBytes(from: source.prefix(count))
  }
}
