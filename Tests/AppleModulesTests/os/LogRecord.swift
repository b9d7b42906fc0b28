import Logging
import SceneModel

@testable import os

/// Records what a logger writes, as lines of level and message.
final class LogRecord: Sendable {
  private let state = Locked<[String]>([])

  var lines: [String] { state.withLock { $0 } }

  /// Writes all levels into the record.
  var logger: os.Logger { logger(level: .trace) }

  /// Writes messages of a level and above into the record.
  func logger(level: Logging.Logger.Level) -> os.Logger {
    os.Logger(Logging.Logger(label: "test") { _ in Handler(record: self, logLevel: level) })
  }

  private func append(_ line: String) { state.withLock { $0.append(line) } }

  private struct Handler: LogHandler {
    let record: LogRecord
    var metadata: Logging.Logger.Metadata = [:]
    var logLevel: Logging.Logger.Level

    subscript(metadataKey key: String) -> Logging.Logger.Metadata.Value? {
      get { metadata[key] }
      set { metadata[key] = newValue }
    }

    func log(
      level: Logging.Logger.Level, message: Logging.Logger.Message,
      metadata: Logging.Logger.Metadata?, source: String, file: String, function: String,
      line: UInt
    ) { record.append("\(level) \(message)") }
  }
}
