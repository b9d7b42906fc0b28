import Logging

/// Writes messages of a program to its log, by way of swift-log.
///
/// Where they end up is for `LoggingSystem.bootstrap` to say; standard error unless a program says
/// otherwise. The label of the swift-log logger is `subsystem:category`.
public struct Logger: Sendable {
  private let logger: Logging.Logger

  /// Creates a logger without a subsystem.
  public init() { self.init(Logging.Logger(quietLabel: "default")) }

  /// Creates a logger for a part of a program.
  ///
  /// - Parameters:
  ///   - subsystem: The program, usually as a reverse domain name.
  ///   - category: The part of it.
  public init(subsystem: String, category: String) {
    self.init(Logging.Logger(quietLabel: "\(subsystem):\(category)"))
  }

  init(_ logger: Logging.Logger) { self.logger = logger }

  /// Writes a message of the level `notice`.
  public func log(_ message: OSLogMessage) { write(message, .notice) }

  /// Writes a message of a level.
  public func log(level: OSLogType, _ message: OSLogMessage) { write(message, level.level) }

  /// Writes what only helps to follow a program step by step.
  public func trace(_ message: OSLogMessage) { write(message, .trace) }

  /// Writes what only helps to find a fault.
  public func debug(_ message: OSLogMessage) { write(message, .debug) }

  /// Writes what may help, but isn't needed, to understand a problem.
  public func info(_ message: OSLogMessage) { write(message, .info) }

  /// Writes what is needed to understand a problem.
  public func notice(_ message: OSLogMessage) { write(message, .notice) }

  /// Writes that something unexpected happened that the program can live with.
  public func warning(_ message: OSLogMessage) { write(message, .warning) }

  /// Writes that something failed.
  public func error(_ message: OSLogMessage) { write(message, .error) }

  /// Writes that something failed that the program needs.
  public func critical(_ message: OSLogMessage) { write(message, .critical) }

  /// Writes that there is a fault in the program.
  public func fault(_ message: OSLogMessage) { write(message, .critical) }

  /// Creates a logger that writes to a log.
  public init(_ logObj: OSLog) { self = logObj.logger }

  /// Whether messages of a level are taken down.
  func isEnabled(_ type: OSLogType) -> Bool { logger.logLevel <= type.level }

  private func write(_ message: OSLogMessage, _ level: Logging.Logger.Level) {
    logger.log(level: level, "\(message.interpolation.text)")
  }
}

/// How important a message is.
public struct OSLogType: RawRepresentable, Hashable, Sendable {
  /// The number of the level.
  public let rawValue: UInt8

  /// Creates a level from its number.
  public init(rawValue: UInt8) { self.rawValue = rawValue }

  /// Needed to understand a problem.
  public static let `default` = OSLogType(rawValue: 0)
  /// May help to understand a problem.
  public static let info = OSLogType(rawValue: 1)
  /// Only helps to find a fault.
  public static let debug = OSLogType(rawValue: 2)
  /// Something failed.
  public static let error = OSLogType(rawValue: 16)
  /// There is a fault in the program.
  public static let fault = OSLogType(rawValue: 17)

  fileprivate var level: Logging.Logger.Level {
    switch self {
    case .debug: .debug
    case .info: .info
    case .error: .error
    case .fault: .critical
    default: .notice
    }
  }
}
