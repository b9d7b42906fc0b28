import Foundation
import Synchronization

/// A lock that protects a value.
public struct OSAllocatedUnfairLock<State>: @unchecked Sendable {
  private final class Storage {
    var state: State
    let lock = NSLock()
    /// The thread that holds the lock; reliable only for comparison with the current thread.
    let holder = Atomic<UInt>(0)

    init(_ state: State) { self.state = state }

    func acquire() {
      lock.lock()
      holder.store(pthread_self(), ordering: .relaxed)
    }

    func tryAcquire() -> Bool {
      guard lock.try() else { return false }
      holder.store(pthread_self(), ordering: .relaxed)
      return true
    }

    func release() {
      holder.store(0, ordering: .relaxed)
      lock.unlock()
    }
  }

  private let storage: Storage

  /// Creates a lock that protects a non-Sendable value, which must be used only under the lock.
  public init(uncheckedState initialState: State) { storage = Storage(initialState) }

  /// Calls a closure with the value while holding the lock.
  public func withLockUnchecked<R>(_ body: (inout State) throws -> R) rethrows -> R {
    storage.acquire()
    defer { storage.release() }
    return try body(&storage.state)
  }

  /// Calls a closure with the value while holding the lock.
  public func withLock<R: Sendable>(
    _ body: @Sendable (inout State) throws -> R
  ) rethrows -> R { try withLockUnchecked(body) }

  /// Calls a closure with the value if the lock is free; returns nil otherwise.
  public func withLockIfAvailable<R: Sendable>(
    _ body: @Sendable (inout State) throws -> R
  ) rethrows -> R? {
    guard storage.tryAcquire() else { return nil }
    defer { storage.release() }
    return try body(&storage.state)
  }
}

extension OSAllocatedUnfairLock {
  /// The owner of a lock.
  public enum Ownership: Hashable, Sendable {
    /// The current thread.
    case owner
    /// Another thread, or none.
    case notOwner
  }

  /// Stops the program unless the ownership of the lock is as given.
  public func precondition(_ condition: Ownership) {
    let isHeld = storage.holder.load(ordering: .relaxed) == pthread_self()
    Swift.precondition(
      isHeld == (condition == .owner),
      isHeld ? "The current thread holds the lock." : "The current thread does not hold the lock.")
  }
}

extension OSAllocatedUnfairLock where State: Sendable {
  /// Creates a lock that protects a value.
  public init(initialState: State) { self.init(uncheckedState: initialState) }
}

extension OSAllocatedUnfairLock where State == Void {
  /// Creates a lock without a value.
  public init() { self.init(uncheckedState: ()) }

  /// Acquires the lock; the same thread must release it.
  public func lock() { storage.acquire() }

  /// Acquires the lock if it is free; returns whether it did.
  public func lockIfAvailable() -> Bool { storage.tryAcquire() }

  /// Releases the lock.
  public func unlock() { storage.release() }

  /// Calls a closure while holding the lock.
  public func withLock<R: Sendable>(_ body: @Sendable () throws -> R) rethrows -> R {
    try withLockUnchecked { _ in try body() }
  }
}
