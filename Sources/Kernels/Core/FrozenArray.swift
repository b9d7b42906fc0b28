/// Elements at a fixed address, immutable after `init`, so that threads may share them.
final class FrozenArray<Element: BitwiseCopyable & Sendable>: Sendable {
  nonisolated(unsafe) let elements: UnsafeBufferPointer<Element>

  /// `fill` initializes all elements.
  init(
    count: Int, fill: (UnsafeMutableBufferPointer<Element>) throws -> Void
  ) rethrows {
    let memory = UnsafeMutableBufferPointer<Element>.allocate(capacity: count)
    do {
      try fill(memory)
    } catch {
      memory.deallocate()
      throw error
    }
    elements = UnsafeBufferPointer(memory)
  }

  init(owning memory: UnsafeMutableBufferPointer<Element>) {
    elements = UnsafeBufferPointer(memory)
  }

  deinit { elements.deallocate() }

  var base: UnsafePointer<Element>? { elements.baseAddress }
}
