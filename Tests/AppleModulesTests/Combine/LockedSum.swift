import SceneModel

/// A sum that several threads add to.
final class LockedSum: Sendable {
  private let sum = Locked(0)

  var value: Int { sum.withLock { $0 } }

  func add(_ number: Int) { sum.withLock { $0 += number } }
}
