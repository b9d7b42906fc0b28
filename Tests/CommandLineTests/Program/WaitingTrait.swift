import TestSupport
import Testing

/// Runs each test on a queue of its own.
struct WaitingTrait: SuiteTrait, TestTrait, TestScoping {
  var isRecursive: Bool { true }

  func provideScope(
    for test: Test, testCase: Test.Case?, performing function: @Sendable () async throws -> Void
  ) async throws {
    try await withTaskExecutorPreference(QueueExecutor()) { try await function() }
  }
}

extension Trait where Self == WaitingTrait {
  /// Marks tests that mostly wait, so that they do not occupy one of the few threads that all tests
  /// share.
  static var mostlyWaiting: Self { Self() }
}
