// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized
import Foundation
import Synchronization

/// A spin lock of one machine word. Waiting threads yield the CPU, so it suits short critical
/// sections.
public struct os_unfair_lock: BitwiseCopyable, Sendable {
  /// The thread that holds the lock, or 0.
  fileprivate var owner: UInt = 0

  /// Creates an unlocked lock.
  public init() {}
}

/// A pointer to a lock.
public typealias os_unfair_lock_t = UnsafeMutablePointer<os_unfair_lock>
/// The name of the lock's C struct.
public typealias os_unfair_lock_s = os_unfair_lock

/// Waits for the lock and acquires it.
public func os_unfair_lock_lock(_ lock: os_unfair_lock_t) {
  while !os_unfair_lock_trylock(lock) { sched_yield() }
}

/// Acquires the lock if it is free; returns whether it did.
public func os_unfair_lock_trylock(_ lock: os_unfair_lock_t) -> Bool {
  owner(of: lock).pointee.compareExchange(
    expected: 0, desired: pthread_self(), ordering: .acquiring
  ).exchanged
}

/// Releases the lock.
public func os_unfair_lock_unlock(_ lock: os_unfair_lock_t) {
  owner(of: lock).pointee.store(0, ordering: .releasing)
}

/// Stops the program unless this thread holds the lock.
public func os_unfair_lock_assert_owner(_ lock: os_unfair_lock_t) {
  let holder = owner(of: lock).pointee.load(ordering: .relaxed)
  precondition(holder == pthread_self(), "This thread doesn't hold the lock.")
}

/// Stops the program if this thread holds the lock.
public func os_unfair_lock_assert_not_owner(_ lock: os_unfair_lock_t) {
  let holder = owner(of: lock).pointee.load(ordering: .relaxed)
  precondition(holder != pthread_self(), "This thread holds the lock.")
}

/// The word of a lock as an atomic.
private func owner(of lock: os_unfair_lock_t) -> UnsafeMutablePointer<Atomic<UInt>> {
  UnsafeMutableRawPointer(lock).assumingMemoryBound(to: Atomic<UInt>.self)
}
