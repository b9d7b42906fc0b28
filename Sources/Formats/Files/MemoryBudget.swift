/// Limits the memory that the content of an untrusted file may need.
///
/// Compressed and repeated content can stand for more memory than any computer has. What a model
/// needs is proportional to the size of its file, with a generous factor.
final class MemoryBudget {
  /// Bytes that a file may take regardless of its size, and for each of its bytes. Chosen.
  private static let base = 64 << 20
  private static let factor = 64

  private var rest = base

  /// A budget for a file of `byteCount` bytes.
  init(forFileOf byteCount: Int) { extend(byFileOf: byteCount) }

  /// Adds what the content of another file of `byteCount` bytes may need.
  func extend(byFileOf byteCount: Int) {
    let (bytes, isLarge) = byteCount.multipliedReportingOverflow(by: Self.factor)
    let (sum, isLarger) = rest.addingReportingOverflow(bytes)
    rest = isLarge || isLarger ? .max : sum
  }

  /// Takes `count` elements of `size` bytes; throws a `FormatFault` if so much isn't left.
  func spend(_ count: Int, of size: Int = 1) throws {
    let (bytes, overflow) = count.multipliedReportingOverflow(by: size)
    guard count >= 0, !overflow, bytes <= rest else {
      throw FormatFault("its content would be much larger than the file")
    }
    rest -= bytes
  }
}
