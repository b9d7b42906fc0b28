import Foundation

/// A value protected by a lock.
///
/// Like `Synchronization.Mutex`, but based on a system lock: on Linux the thread sanitizer doesn't
/// know `Mutex` and reports false data races on what it protects.
package final class Locked<Value>: @unchecked Sendable {
  private let lock = NSLock()
  private var value: Value

  package init(_ value: sending Value) { self.value = value }

  /// Calls `body` with exclusive access to the value. Not reentrant.
  package func withLock<Result, Failure: Error>(
    _ body: (inout Value) throws(Failure) -> Result
  ) throws(Failure) -> Result {
    lock.lock()
    defer { lock.unlock() }
    return try body(&value)
  }
}
