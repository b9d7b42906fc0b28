import Dispatch
import Foundation

/// Where work can be done.
public protocol Scheduler {
  /// Does work soon.
  func schedule(_ action: @escaping () -> Void)
}

extension DispatchQueue: Scheduler {
  /// Does work on the queue.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    async { action() }
  }
}

extension OperationQueue: Scheduler {
  /// Does work on the queue.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    addOperation { action() }
  }
}

extension RunLoop: Scheduler {
  /// Does work on the run loop.
  public func schedule(_ action: @escaping () -> Void) {
    nonisolated(unsafe) let action = action
    perform { action() }
  }
}

/// Does work at once.
public struct ImmediateScheduler: Scheduler, Sendable {
  /// The only one.
  public static let shared = ImmediateScheduler()

  /// Does work at once.
  public func schedule(_ action: @escaping () -> Void) { action() }
}
