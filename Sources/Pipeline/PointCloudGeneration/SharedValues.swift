import SceneModel

/// Values by index that are made when somebody first asks for one and shared while anybody holds
/// them; the latest used are kept a while longer.
///
/// Thread-safe: a value that two threads ask for at once is made by one of them.
final class SharedValues<Value: AnyObject & Sendable>: Sendable {
  private struct Weak {
    weak var value: Value?
  }

  private final class Slot: Sendable {
    let content = Locked(Weak())
  }

  private struct State {
    /// The latest used last.
    var kept: [(index: Int, value: Value)] = []
    var live: [Weak] = []
    var peakCount = 0
  }

  private let slots: [Slot]
  private let capacity: Int
  private let state = Locked(State())

  /// `capacity` bounds the values that are kept between calls, not those that callers hold.
  init(count: Int, capacity: Int) {
    slots = (0..<count).map { _ in Slot() }
    self.capacity = max(0, capacity)
  }

  /// The most values that lived at once.
  var peakCount: Int { state.withLock { $0.peakCount } }

  func value(_ index: Int, _ make: () throws -> Value) throws -> Value {
    var isNew = false
    let value = try slots[index].content.withLock { content in
      if let value = content.value { return value }
      let value = try make()
      content.value = value
      isNew = true
      return value
    }
    note(value, index, isNew: isNew)
    return value
  }

  /// Keeps a value that was just used, and counts those alive.
  private func note(_ value: Value, _ index: Int, isNew: Bool) {
    // Freed after the lock.
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
