/// Elements at a fixed address with a single owner, mutable until they are frozen.
struct UniqueArray<Element: BitwiseCopyable & Sendable>: ~Copyable {
  let elements: UnsafeMutableBufferPointer<Element>

  init(repeating element: Element, count: Int) {
    elements = .allocate(capacity: count)
    elements.initialize(repeating: element)
  }

  deinit { elements.deallocate() }

  /// Transfers the memory without copying it.
  consuming func frozen() -> FrozenArray<Element> {
    let elements = elements
    discard self
    return FrozenArray(owning: elements)
  }
}
