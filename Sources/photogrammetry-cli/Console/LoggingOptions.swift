import ArgumentParser
import Logging

/// How much is told.
struct LoggingOptions: ParsableArguments {
  @Flag(name: .long, help: "Say nothing but errors; results still go to stdout.")
  var quiet = false

  @Flag(name: .long, help: "Say more: everything the engine logs.")
  var verbose = false

  func validate() throws {
    if quiet, verbose { throw ValidationError("--quiet and --verbose exclude each other.") }
  }

  /// Sends all logging to stderr.
  func bootstrap() {
    let level: Logger.Level = quiet ? .error : verbose ? .debug : .info
    LoggingSystem.bootstrap { ConsoleLogHandler(label: $0, logLevel: level) }
  }

  /// The way of telling progress that fits these options.
  func style(json: Bool) -> RunReporter.Style {
    if json { return .json }
    if quiet { return .quiet }
    return Terminal.shared.isInteractive ? .bar : .lines
  }
}
