import Foundation

/// Marks intervals and events. There is no tool that displays them here: they are logged at the
/// level `trace`, with the duration at the end of each interval.
public struct OSSignposter: Sendable {
  private let logger: Logger?

  /// Creates a signposter without a subsystem.
  public init() { logger = Logger() }

  /// Creates a signposter for a part of a program.
  public init(subsystem: String, category: String) {
    logger = Logger(subsystem: subsystem, category: category)
  }

  /// Creates a signposter for a part of a program.
  public init(subsystem: String, category: OSLog.Category) {
    self.init(subsystem: subsystem, category: category.rawValue)
  }

  /// Creates a signposter that writes to a logger.
  public init(logger: Logger) { self.logger = logger }

  /// Creates a signposter that writes to a log.
  public init(logHandle: OSLog) { logger = logHandle.logger }

  private init(silent: Void) { logger = nil }

  /// A signposter that discards everything.
  public static let disabled = OSSignposter(silent: ())

  /// Whether signposts are written.
  public var isEnabled: Bool { logger?.isEnabled(.debug) ?? false }

  /// Makes a random identifier for an interval.
  public func makeSignpostID() -> OSSignpostID {
    OSSignpostID(UInt64.random(in: 1..<UInt64.max))
  }

  /// Makes an identifier for an object.
  public func makeSignpostID(from object: AnyObject) -> OSSignpostID {
    OSSignpostID(UInt64(UInt(bitPattern: ObjectIdentifier(object))))
  }

  /// Begins an interval.
  public func beginInterval(
    _ name: StaticString, id: OSSignpostID = .exclusive
  ) -> OSSignpostIntervalState { begin(name, id, "") }

  /// Begins an interval with a message.
  public func beginInterval(
    _ name: StaticString, id: OSSignpostID = .exclusive, _ message: OSLogMessage
  ) -> OSSignpostIntervalState { begin(name, id, " \(message.interpolation.text)") }

  /// Ends an interval.
  public func endInterval(_ name: StaticString, _ state: OSSignpostIntervalState) {
    end(name, state, "")
  }

  /// Ends an interval with a message.
  public func endInterval(
    _ name: StaticString, _ state: OSSignpostIntervalState, _ message: OSLogMessage
  ) { end(name, state, " \(message.interpolation.text)") }

  /// Emits an event.
  public func emitEvent(_ name: StaticString, id: OSSignpostID = .exclusive) { write("\(name)") }

  /// Emits an event with a message.
  public func emitEvent(
    _ name: StaticString, id: OSSignpostID = .exclusive, _ message: OSLogMessage
  ) { write("\(name) \(message.interpolation.text)") }

  /// Runs a closure as an interval.
  public func withIntervalSignpost<T>(
    _ name: StaticString, id: OSSignpostID = .exclusive, around task: () throws -> T
  ) rethrows -> T {
    let state = beginInterval(name, id: id)
    defer { endInterval(name, state) }
    return try task()
  }

  /// Runs a closure as an interval with a message.
  public func withIntervalSignpost<T>(
    _ name: StaticString, id: OSSignpostID = .exclusive, _ message: OSLogMessage,
    around task: () throws -> T
  ) rethrows -> T {
    let state = beginInterval(name, id: id, message)
    defer { endInterval(name, state) }
    return try task()
  }

  private func begin(
    _ name: StaticString, _ id: OSSignpostID, _ message: String
  ) -> OSSignpostIntervalState {
    write("\(name) begins\(message)")
    return OSSignpostIntervalState(id)
  }

  private func end(_ name: StaticString, _ state: OSSignpostIntervalState, _ message: String) {
    let seconds = String(format: "%.3f", state.seconds)
    write("\(name) ends after \(seconds) s\(message)")
  }

  private func write(_ text: String) { logger?.trace("\(text, privacy: .public)") }
}

/// Distinguishes overlapping intervals of the same name.
public struct OSSignpostID: RawRepresentable, Hashable, Comparable, Sendable {
  /// The number of the interval.
  public let rawValue: UInt64

  /// Creates an identifier from its number.
  public init(rawValue: UInt64) { self.rawValue = rawValue }

  /// Creates an identifier from its number.
  public init(_ value: UInt64) { rawValue = value }

  /// Creates a unique identifier for an interval of a log.
  public init(log: OSLog) { self.init(UInt64.random(in: 1..<UInt64.max)) }

  /// For names with at most one interval at a time.
  public static let exclusive = OSSignpostID(0xEEEE_B0B5_B2B2_EEEE)
  /// No interval.
  public static let null = OSSignpostID(0)
  /// An invalid identifier.
  public static let invalid = OSSignpostID(UInt64.max)

  /// Whether the number of the first is smaller.
  public static func < (lhs: OSSignpostID, rhs: OSSignpostID) -> Bool {
    lhs.rawValue < rhs.rawValue
  }
}

/// The state of an interval that has begun.
public final class OSSignpostIntervalState: Sendable {
  /// The identifier of the interval.
  public let signpostID: OSSignpostID
  private let start = ProcessInfo.processInfo.systemUptime

  init(_ id: OSSignpostID) { signpostID = id }

  fileprivate var seconds: TimeInterval { ProcessInfo.processInfo.systemUptime - start }
}

/// What a signpost marks.
public enum OSSignpostType: UInt8, Hashable, Sendable {
  /// A point in time.
  case event
  /// The beginning of an interval.
  case begin
  /// The end of an interval.
  case end
}

/// Emits a signpost: a log message at the level `trace`.
public func os_signpost(
  _ type: OSSignpostType, log: OSLog, name: StaticString,
  signpostID: OSSignpostID = .exclusive
) { log.logger.trace("\(name.description, privacy: .public) \(verb(type), privacy: .public)") }

/// Emits a signpost with a message.
public func os_signpost(
  _ type: OSSignpostType, log: OSLog, name: StaticString,
  signpostID: OSSignpostID = .exclusive, _ format: StaticString, _ arguments: any CVarArg...
) {
  let text = LogFormat(format.description).text(arguments)
  log.logger.trace("\(name.description) \(verb(type)) \(text, privacy: .public)")
}

private func verb(_ type: OSSignpostType) -> String {
  switch type {
  case .event: "happens"
  case .begin: "begins"
  case .end: "ends"
  }
}
