import ArgumentParser
import Logging

/// How much a command prints.
package struct LoggingOptions: ParsableArguments {
  @Flag(name: .long, help: "Print errors only; results still go to stdout.")
  package var quiet = false

  @Flag(name: .long, help: "Print everything that the engine logs.")
  package var verbose = false

  package init() {}

  package func validate() throws {
    if quiet, verbose { throw ValidationError("--quiet and --verbose are mutually exclusive.") }
  }

  /// Sends all logging to stderr. Call once per process.
  ///
  /// Warnings with the source `sessionOutputSource` are not repeated as JSON events.
  package func bootstrap(sessionOutputSource: String? = nil) {
    let level: Logger.Level = quiet ? .error : verbose ? .debug : .info
    LoggingSystem.bootstrap {
      ConsoleLogHandler(label: $0, logLevel: level, sessionOutputSource: sessionOutputSource)
    }
  }

  /// The form of progress that fits these options and the terminal.
  package func style(json: Bool = false) -> RunReporter.Style {
    if json { return .json }
    if quiet { return .quiet }
    return Terminal.shared.isInteractive ? .bar : .lines
  }
}
