import Foundation
import Logging

/// A log for `os_log` and `os_signpost`.
public final class OSLog: Sendable {
  let logger: Logger

  /// Creates a log for a part of a program.
  public init(subsystem: String, category: String) {
    logger = Logger(subsystem: subsystem, category: category)
  }

  /// Creates a log for a part of a program.
  public convenience init(subsystem: String, category: Category) {
    self.init(subsystem: subsystem, category: category.rawValue)
  }

  private init(_ logger: Logger) { self.logger = logger }

  /// The log without a subsystem.
  public static let `default` = OSLog(Logger())
  /// The log that discards all messages.
  public static let disabled = OSLog(
    Logger(Logging.Logger(label: "", factory: { _ in NullLogHandler() })))

  /// Whether messages at a level are logged.
  public func isEnabled(type: OSLogType) -> Bool { logger.isEnabled(type) }

  /// Whether signposts are logged.
  public var signpostsEnabled: Bool { logger.isEnabled(.debug) }

  /// Well-known categories.
  public struct Category: RawRepresentable, Hashable, Sendable {
    /// The name of the category.
    public let rawValue: String

    /// Creates a category from its name.
    public init(rawValue: String) { self.rawValue = rawValue }

    /// Events that profiling tools display.
    public static let pointsOfInterest = Category(rawValue: "PointsOfInterest")
  }
}

extension Logger {
  /// Creates a logger for an existing log.
  public init(_ logObj: OSLog) { self = logObj.logger }
}

/// A log handler that discards all messages.
private struct NullLogHandler: LogHandler {
  var logLevel = Logging.Logger.Level.critical
  var metadata: Logging.Logger.Metadata = [:]

  subscript(metadataKey key: String) -> Logging.Logger.Metadata.Value? {
    get { metadata[key] }
    set { metadata[key] = newValue }
  }

  func log(
    level: Logging.Logger.Level, message: Logging.Logger.Message,
    metadata: Logging.Logger.Metadata?, source: String, file: String, function: String, line: UInt
  ) {}
}

/// Writes a message with a format string in the syntax of `printf`: `%d`, `%{public}@`, `%.2f` ….
///
/// Values marked `private` or `sensitive` are redacted.
public func os_log(
  _ message: StaticString, log: OSLog = .default,
  type: OSLogType = .default, _ args: any CVarArg...
) { write(message, log, type, args) }

/// Writes a message with a format string in the syntax of `printf`.
public func os_log(
  _ type: OSLogType, log: OSLog = .default, _ message: StaticString,
  _ args: any CVarArg...
) { write(message, log, type, args) }

/// Writes an interpolated message.
public func os_log(_ message: OSLogMessage) { OSLog.default.logger.log(message) }

/// Writes an interpolated message at a level.
public func os_log(_ type: OSLogType, log: OSLog = .default, _ message: OSLogMessage) {
  log.logger.log(level: type, message)
}

private func write(
  _ message: StaticString, _ log: OSLog, _ type: OSLogType, _ values: [any CVarArg]
) {
  guard log.isEnabled(type: type) else { return }
  let text = LogFormat(message.description).text(values)
  log.logger.log(level: type, "\(text, privacy: .public)")
}
