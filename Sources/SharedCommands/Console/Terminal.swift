import Foundation
import SceneModel

/// The process's stdout and stderr: results go to stdout, everything else to stderr.
///
/// A status line at the bottom of a terminal is removed for messages and redrawn after them.
package final class Terminal: Sendable {
  /// The process's only terminal.
  package static let shared = Terminal()

  /// Whether stderr is a terminal that can redraw a line.
  package let isInteractive: Bool
  /// Whether messages may contain color codes; the variable `NO_COLOR` prevents it.
  let usesColor: Bool
  private let status = Locked("")

  private init() {
    let environment = ProcessInfo.processInfo.environment
    isInteractive = isatty(STDERR_FILENO) == 1 && environment["TERM"] != "dumb"
    usesColor = isInteractive && environment["NO_COLOR"] == nil
  }

  /// Columns of the terminal; 80 if stderr is not a terminal.
  package var width: Int {
    var size = winsize()
    guard ioctl(STDERR_FILENO, UInt(TIOCGWINSZ), &size) == 0, size.ws_col > 0 else { return 80 }
    return Int(size.ws_col)
  }

  /// Writes a line to stdout.
  package func result(_ line: String) {
    status.withLock { status in
      clear(status)
      write(line + "\n", to: .standardOutput)
      write(status, to: .standardError)
    }
  }

  /// Writes a line to stderr.
  package func message(_ line: String) {
    status.withLock { status in
      clear(status)
      write(line + "\n" + status, to: .standardError)
    }
  }

  /// Shows `line` at the bottom until the next one; an empty one removes it.
  package func show(status line: String) {
    guard isInteractive else { return }
    status.withLock { status in
      clear(status)
      status = line
      write(line, to: .standardError)
    }
  }

  /// Makes writing to a closed pipe an error instead of a fatal signal.
  package func ignoreBrokenPipes() { signal(SIGPIPE, SIG_IGN) }

  private func clear(_ status: String) {
    if !status.isEmpty { write("\r\u{1B}[K", to: .standardError) }
  }

  /// Drops what can't be written, to a closed pipe or full disk: it can't be reported anywhere.
  private func write(_ text: String, to handle: FileHandle) {
    guard !text.isEmpty else { return }
    try? handle.write(contentsOf: Data(text.utf8))
  }
}
