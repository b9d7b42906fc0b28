import Logging

/// Writes log messages through swift-log.
///
/// `LoggingSystem.bootstrap` selects the destination; without it messages go to standard error. The
/// label of the swift-log logger is `subsystem:category`.
public struct Logger: Sendable {
  private let logger: Logging.Logger

  /// Creates a logger without a subsystem.
  public init() { self.init(Logging.Logger(standardErrorLabel: "default")) }

  /// Creates a logger for a part of a program.
  ///
  /// - Parameters:
  ///   - subsystem: The program, usually in reverse-DNS notation.
  ///   - category: The part of the program.
  public init(subsystem: String, category: String) {
    self.init(Logging.Logger(standardErrorLabel: "\(subsystem):\(category)"))
  }

  init(_ logger: Logging.Logger) { self.logger = logger }

  /// Writes a message at the level `notice`.
  public func log(_ message: OSLogMessage) { write(message, .notice) }

  /// Writes a message at a level.
  public func log(level: OSLogType, _ message: OSLogMessage) { write(message, level.level) }

  /// Writes a message that traces the execution in detail.
  public func trace(_ message: OSLogMessage) { write(message, .trace) }

  /// Writes a message for debugging.
  public func debug(_ message: OSLogMessage) { write(message, .debug) }

  /// Writes a message that is helpful, but not essential, for troubleshooting.
  public func info(_ message: OSLogMessage) { write(message, .info) }

  /// Writes a message that is essential for troubleshooting.
  public func notice(_ message: OSLogMessage) { write(message, .notice) }

  /// Writes a message about an unexpected condition from which the program can recover.
  public func warning(_ message: OSLogMessage) { write(message, .warning) }

  /// Writes a message about an error.
  public func error(_ message: OSLogMessage) { write(message, .error) }

  /// Writes a message about a critical error.
  public func critical(_ message: OSLogMessage) { write(message, .critical) }

  /// Writes a message about a bug in the program.
  public func fault(_ message: OSLogMessage) { write(message, .critical) }

  /// Whether messages at a level are logged.
  func isEnabled(_ type: OSLogType) -> Bool { logger.logLevel <= type.level }

  private func write(_ message: OSLogMessage, _ level: Logging.Logger.Level) {
    logger.log(level: level, "\(message.interpolation.text)")
  }
}
