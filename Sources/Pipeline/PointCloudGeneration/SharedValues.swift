import SceneModel

/// A cache of values by index: created on first use, shared while any caller holds them, and the
/// most recently used kept a while longer.
///
/// Thread-safe: of several threads that request the same value at once, one creates it.
final class SharedValues<Value: AnyObject & Sendable>: Sendable {
  private struct Weak {
    weak var value: Value?
  }

  private final class Slot: Sendable {
    let content = Locked(Weak())
  }

  private struct State {
    /// Most recently used last.
    var kept: [(index: Int, value: Value)] = []
    var live: [Weak] = []
    var peakCount = 0
  }

  private let slots: [Slot]
  private let capacity: Int
  private let state = Locked(State())

  /// `capacity` limits the values that are cached between calls, not those that callers hold.
  init(count: Int, capacity: Int) {
    slots = (0..<count).map { _ in Slot() }
    self.capacity = max(0, capacity)
  }

  /// The peak number of values alive at once.
  var peakCount: Int { state.withLock { $0.peakCount } }

  /// The cached value at `index`, or a new one from `make`.
  func value(_ index: Int, _ make: () throws -> Value) throws -> Value {
    var isNew = false
    let value = try slots[index].content.withLock { content in
      if let value = content.value { return value }
      let value = try make()
      content.value = value
      isNew = true
      return value
    }
    touch(value, index, isNew: isNew)
    return value
  }

  /// Caches a value that was just used, and updates the peak count.
  private func touch(_ value: Value, _ index: Int, isNew: Bool) {
    // Released after the lock.
    var dropped: [(index: Int, value: Value)] = []
    state.withLock { state in
      state.kept.removeAll { $0.index == index }
      state.kept.append((index, value))
      let excess = max(0, state.kept.count - capacity)
      dropped += state.kept.prefix(excess)
      state.kept.removeFirst(excess)
      guard isNew else { return }
      state.live.removeAll { $0.value == nil }
      state.live.append(Weak(value: value))
      state.peakCount = max(state.peakCount, state.live.count)
    }
    withExtendedLifetime(dropped) {}
  }
}
