import Dispatch
import Foundation

/// Where and when work is executed.
public protocol Scheduler {
  /// Runs a closure at the next opportunity.
  func schedule(_ action: @escaping () -> Void)
}

extension DispatchQueue: Scheduler {
  /// Runs a closure on the queue.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    async { action() }
  }
}

extension OperationQueue: Scheduler {
  /// Runs a closure on the queue.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    addOperation { action() }
  }
}

extension RunLoop: Scheduler {
  /// Runs a closure on the run loop.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    perform { action() }
  }
}

/// Runs closures immediately.
public struct ImmediateScheduler: Scheduler, Sendable {
  /// The shared scheduler.
  public static let shared = ImmediateScheduler()

  /// Runs a closure immediately.
  public func schedule(_ action: @escaping () -> Void) { action() }
}
