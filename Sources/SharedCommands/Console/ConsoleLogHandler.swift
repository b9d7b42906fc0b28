import Logging
import Synchronization

/// Writes log messages to stderr in a readable form: `warning: a sentence`.
struct ConsoleLogHandler: LogHandler {
  /// Whether errors that the session logs are dropped: the command prints them as its last line.
  static let hidesSessionErrors = Atomic<Bool>(false)

  /// Whether warnings are also written as JSON events.
  static let writesWarningEvents = Atomic<Bool>(false)

  let label: String
  var logLevel: Logger.Level
  var metadata: Logger.Metadata = [:]
  /// The source of log messages that repeat outputs of the session, which are written as separate
  /// JSON events; nil if the session logs no outputs.
  var sessionOutputSource: String?

  subscript(metadataKey key: String) -> Logger.Metadata.Value? {
    get { metadata[key] }
    set { metadata[key] = newValue }
  }

  func log(
    level: Logger.Level, message: Logger.Message, metadata: Logger.Metadata?, source: String,
    file: String, function: String, line: UInt
  ) {
    if level == .error, label.hasPrefix("photogrammetry.session"),
      Self.hidesSessionErrors.load(ordering: .relaxed)
    {
      return
    }
    let fields = self.metadata.merging(metadata ?? [:]) { $1 }.sorted { $0.key < $1.key }
      .map { " \($0.key)=\($0.value)" }.joined()
    if level == .warning, source != sessionOutputSource,
      Self.writesWarningEvents.load(ordering: .relaxed)
    {
      RunEvent("warning") { $0.message = "\(message)" }.write()
    }
    Terminal.shared.message(Self.prefix(level) + "\(message)" + fields)
  }

  private static func prefix(_ level: Logger.Level) -> String {
    let (word, color) =
      switch level {
      case .trace, .debug: ("debug", 90)
      case .info, .notice: ("", 0)
      case .warning: ("warning", 33)
      case .error, .critical: ("error", 31)
      }
    guard !word.isEmpty else { return "" }
    return Terminal.shared.usesColor ? "\u{1B}[\(color)m\(word):\u{1B}[0m " : "\(word): "
  }
}
