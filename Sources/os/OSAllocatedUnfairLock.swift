import Foundation

/// A lock that guards a value.
public struct OSAllocatedUnfairLock<State>: @unchecked Sendable {
  private final class Storage {
    var state: State
    let lock = NSLock()

    init(_ state: State) { self.state = state }
  }

  private let storage: Storage

  /// Creates a lock that guards a value which may only be used under the lock.
  public init(uncheckedState initialState: State) { storage = Storage(initialState) }

  /// Does work on the value while no other thread does.
  public func withLockUnchecked<R>(_ body: (inout State) throws -> R) rethrows -> R {
    storage.lock.lock()
    defer { storage.lock.unlock() }
    return try body(&storage.state)
  }

  /// Does work on the value while no other thread does.
  public func withLock<R: Sendable>(
    _ body: @Sendable (inout State) throws -> R
  ) rethrows -> R { try withLockUnchecked(body) }

  /// Does work on the value unless another thread does; nil then.
  public func withLockIfAvailable<R: Sendable>(
    _ body: @Sendable (inout State) throws -> R
  ) rethrows -> R? {
    guard storage.lock.try() else { return nil }
    defer { storage.lock.unlock() }
    return try body(&storage.state)
  }
}

extension OSAllocatedUnfairLock where State: Sendable {
  /// Creates a lock that guards a value.
  public init(initialState: State) { self.init(uncheckedState: initialState) }
}

extension OSAllocatedUnfairLock where State == Void {
  /// Creates a lock without a value.
  public init() { self.init(uncheckedState: ()) }

  /// Takes the lock; `unlock` must follow on the same thread.
  public func lock() { storage.lock.lock() }

  /// Takes the lock if no other thread has it, and says whether it did.
  public func lockIfAvailable() -> Bool { storage.lock.try() }

  /// Gives the lock back.
  public func unlock() { storage.lock.unlock() }

  /// Does work while no other thread does.
  public func withLock<R: Sendable>(_ body: @Sendable () throws -> R) rethrows -> R {
    try withLockUnchecked { _ in try body() }
  }
}
