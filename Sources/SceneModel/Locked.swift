import Foundation

/// A value that one thread at a time can use.
///
/// As `Synchronization.Mutex`, with a lock of the system's instead: the thread sanitizer doesn't know
/// that one on Linux, and takes what it guards for data races.
package final class Locked<Value>: @unchecked Sendable {
  private let lock = NSLock()
  private var value: Value

  package init(_ value: sending Value) { self.value = value }

  /// Calls `body` with the value while no other thread has it; must not be called from `body`.
  package func withLock<Result, Failure: Error>(
    _ body: (inout Value) throws(Failure) -> Result
  ) throws(Failure) -> Result {
    lock.lock()
    defer { lock.unlock() }
    return try body(&value)
  }
}
