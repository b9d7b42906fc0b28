import Foundation
import Synchronization

/// A lock that guards a value.
public struct OSAllocatedUnfairLock<State>: @unchecked Sendable {
  private final class Storage {
    var state: State
    let lock = NSLock()
    /// The thread that holds the lock; of use to that thread only.
    let holder = Atomic<UInt>(0)

    init(_ state: State) { self.state = state }

    func enter() {
      lock.lock()
      holder.store(pthread_self(), ordering: .relaxed)
    }

    func enterIfFree() -> Bool {
      guard lock.try() else { return false }
      holder.store(pthread_self(), ordering: .relaxed)
      return true
    }

    func leave() {
      holder.store(0, ordering: .relaxed)
      lock.unlock()
    }
  }

  private let storage: Storage

  /// Creates a lock that guards a value which may only be used under the lock.
  public init(uncheckedState initialState: State) { storage = Storage(initialState) }

  /// Does work on the value while no other thread does.
  public func withLockUnchecked<R>(_ body: (inout State) throws -> R) rethrows -> R {
    storage.enter()
    defer { storage.leave() }
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
    guard storage.enterIfFree() else { return nil }
    defer { storage.leave() }
    return try body(&storage.state)
  }
}

extension OSAllocatedUnfairLock {
  /// Who holds a lock.
  public enum Ownership: Hashable, Sendable {
    /// The thread that asks.
    case owner
    /// Another thread, or none.
    case notOwner
  }

  /// Stops the program unless the lock is held, or not held, by this thread.
  public func precondition(_ condition: Ownership) {
    let isHeld = storage.holder.load(ordering: .relaxed) == pthread_self()
    Swift.precondition(isHeld == (condition == .owner), "The lock isn't as expected.")
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
  public func lock() { storage.enter() }

  /// Takes the lock if no other thread has it, and says whether it did.
  public func lockIfAvailable() -> Bool { storage.enterIfFree() }

  /// Gives the lock back.
  public func unlock() { storage.leave() }

  /// Does work while no other thread does.
  public func withLock<R: Sendable>(_ body: @Sendable () throws -> R) rethrows -> R {
    try withLockUnchecked { _ in try body() }
  }
}
