import Logging

extension Logging.Logger {
  /// A logger that writes where the program says by `LoggingSystem.bootstrap`, and to standard error
  /// where it says nothing.
  ///
  /// swift-log itself would write to standard output then, which belongs to what a program prints; on
  /// a Mac no log goes there. It does not tell whether a program said something, so a plain
  /// `StreamLogHandler` counts as nothing.
  package init(quietLabel label: String) {
    self.init(label: label)
    if Self.holdsPlainHandler(Mirror(reflecting: self), depth: 2) {
      self.init(label: label) { StreamLogHandler.standardError(label: $0) }
    }
  }

  /// Looks into a logger, which keeps its handler to itself: some releases of swift-log in a box.
  private static func holdsPlainHandler(_ value: Mirror, depth: Int) -> Bool {
    value.children.contains { child in
      child.value is StreamLogHandler
        || depth > 1 && holdsPlainHandler(Mirror(reflecting: child.value), depth: depth - 1)
    }
  }
}
