import Kernels
import SceneModel

/// Makes values for consecutive ranges of 0..<`count`, of `size` each, and calls `use` for them in
/// their order, while those of the next range are made. So few values exist at a time that their
/// memory can be used again.
func readingAhead<Value: Sendable>(
  _ count: Int, by size: Int, _ control: KernelControl,
  make: @escaping @Sendable (Range<Int>, KernelControl) throws -> Value,
  use: (Range<Int>, Value) throws -> Void
) throws {
  @Sendable func made(from start: Int) throws -> (range: Range<Int>, value: Value)? {
    guard start < count else { return nil }
    let range = start..<min(start + size, count)
    let part = control.part(
      from: Double(start) / Double(count), to: Double(range.upperBound) / Double(count))
    return (range, try make(range, part))
  }
  let next = Locked(try made(from: 0))
  while let (range, value) = next.withLock({ $0.take() }) {
    try beside(
      {
        let found = try made(from: range.upperBound)
        next.withLock { $0 = found }
      }, control
    ) { try use(range, value) }
  }
}
