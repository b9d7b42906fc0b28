import Logging

extension Logging.Logger {
  /// A logger with the handler from `LoggingSystem.bootstrap`, or one for standard error if the
  /// program has not bootstrapped logging.
  ///
  /// In that case swift-log itself would write to standard output, which belongs to the program's
  /// own output; on macOS no log goes there. swift-log does not expose whether it was bootstrapped,
  /// so a plain `StreamLogHandler` counts as its default.
  package init(standardErrorLabel label: String) {
    self.init(label: label)
    if Self.containsDefaultHandler(Mirror(reflecting: self), depth: 2) {
      self.init(label: label) { StreamLogHandler.standardError(label: $0) }
    }
  }

  /// Searches a logger for a plain handler by reflection; some releases of swift-log box the
  /// handler.
  private static func containsDefaultHandler(_ value: Mirror, depth: Int) -> Bool {
    value.children.contains { child in
      child.value is StreamLogHandler
        || depth > 1 && containsDefaultHandler(Mirror(reflecting: child.value), depth: depth - 1)
    }
  }
}
