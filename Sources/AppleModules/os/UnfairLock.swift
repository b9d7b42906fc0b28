// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized
import Foundation
import Synchronization

/// A lock that is one word of memory. Whoever waits for it spins and lets others run in between, so it
/// suits work as short as such locks are meant for.
public struct os_unfair_lock: BitwiseCopyable, Sendable {
  /// The thread that holds the lock, or 0.
  fileprivate var owner: UInt = 0

  /// Creates a lock that nobody holds.
  public init() {}
}

/// Where a lock is.
public typealias os_unfair_lock_t = UnsafeMutablePointer<os_unfair_lock>
/// The lock by its older name.
public typealias os_unfair_lock_s = os_unfair_lock

/// Waits for the lock and takes it.
public func os_unfair_lock_lock(_ lock: os_unfair_lock_t) {
  while !os_unfair_lock_trylock(lock) { sched_yield() }
}

/// Takes the lock if nobody holds it.
public func os_unfair_lock_trylock(_ lock: os_unfair_lock_t) -> Bool {
  owner(of: lock).pointee.compareExchange(
    expected: 0, desired: pthread_self(), ordering: .acquiring
  ).exchanged
}

/// Gives the lock back.
public func os_unfair_lock_unlock(_ lock: os_unfair_lock_t) {
  owner(of: lock).pointee.store(0, ordering: .releasing)
}

/// Stops the program if another thread holds the lock, or none.
public func os_unfair_lock_assert_owner(_ lock: os_unfair_lock_t) {
  let holder = owner(of: lock).pointee.load(ordering: .relaxed)
  precondition(holder == pthread_self(), "This thread doesn't hold the lock.")
}

/// Stops the program if this thread holds the lock.
public func os_unfair_lock_assert_not_owner(_ lock: os_unfair_lock_t) {
  let holder = owner(of: lock).pointee.load(ordering: .relaxed)
  precondition(holder != pthread_self(), "This thread holds the lock.")
}

/// The word of a lock as what it has to be while threads compete for it.
private func owner(of lock: os_unfair_lock_t) -> UnsafeMutablePointer<Atomic<UInt>> {
  UnsafeMutableRawPointer(lock).assumingMemoryBound(to: Atomic<UInt>.self)
}
