import Foundation
import SceneModel
import Testing
import os

@Suite struct UnfairLockTests {
  @Test func onlyOneHolderAtATime() {
    var lock = os_unfair_lock()
    #expect(os_unfair_lock_trylock(&lock) && !os_unfair_lock_trylock(&lock))
    os_unfair_lock_assert_owner(&lock)
    os_unfair_lock_unlock(&lock)
    os_unfair_lock_assert_not_owner(&lock)
    #expect(os_unfair_lock_trylock(&lock))
  }

  @Test func threadsTakeTurns() {
    let shared = os_unfair_lock_t.allocate(capacity: 1)
    shared.initialize(to: os_unfair_lock())
    defer { shared.deallocate() }
    nonisolated(unsafe) let lock = shared
    nonisolated(unsafe) let sum = UnsafeMutablePointer<Int>.allocate(capacity: 1)
    sum.initialize(to: 0)
    defer { sum.deallocate() }
    DispatchQueue.concurrentPerform(iterations: 2000) { _ in
      os_unfair_lock_lock(lock)
      sum.pointee += 1
      os_unfair_lock_unlock(lock)
    }
    #expect(sum.pointee == 2000)
  }

  @Test func lockedStatesAreNotAvailableToOtherThreads() async {
    let lock = OSAllocatedUnfairLock(initialState: 1)
    let value = lock.withLock { state in
      state = 2
      let isFree = Locked<Bool?>(nil)
      let thread = Thread {
        isFree.withLock { $0 = lock.withLockIfAvailable { _ in true } ?? false }
      }
      thread.start()
      while isFree.withLock({ $0 }) == nil { usleep(100) }
      return isFree.withLock { $0 }
    }
    #expect(value == false && lock.withLockIfAvailable { $0 } == 2)
  }

  @Test func errorsReleaseTheLock() {
    let lock = OSAllocatedUnfairLock(initialState: 0)
    #expect(throws: CocoaError.self) {
      try lock.withLock { state in
        state = 5
        throw CocoaError(.fileNoSuchFile)
      }
    }
    #expect(lock.withLockIfAvailable { $0 } == 5)
    lock.precondition(.notOwner)
    lock.withLock { _ in lock.precondition(.owner) }
  }

  @Test func violatedOwnershipStopsTheProgram() async {
    await #expect(processExitsWith: .failure) {
      let lock = OSAllocatedUnfairLock(initialState: 0)
      lock.precondition(.owner)
    }
    await #expect(processExitsWith: .failure) {
      var lock = os_unfair_lock()
      os_unfair_lock_assert_owner(&lock)
    }
    await #expect(processExitsWith: .failure) {
      var lock = os_unfair_lock()
      os_unfair_lock_lock(&lock)
      os_unfair_lock_assert_not_owner(&lock)
    }
  }
}
