import Foundation
import SceneModel

/// The process's stdout and stderr: results to the one, everything else to the other.
///
/// A status line at the bottom of a terminal is taken away for messages and drawn again after them.
final class Terminal: Sendable {
  static let shared = Terminal()

  /// Whether somebody looks at stderr.
  let isInteractive: Bool
  let usesColor: Bool
  private let status = Locked("")

  private init() {
    let environment = ProcessInfo.processInfo.environment
    isInteractive = isatty(STDERR_FILENO) == 1 && environment["TERM"] != "dumb"
    usesColor = isInteractive && environment["NO_COLOR"] == nil
  }

  /// Columns of the terminal.
  var width: Int {
    var size = winsize()
    guard ioctl(STDERR_FILENO, UInt(TIOCGWINSZ), &size) == 0, size.ws_col > 0 else { return 80 }
    return Int(size.ws_col)
  }

  /// Writes a line to stdout.
  func result(_ line: String) {
    status.withLock { status in
      clear(status)
      write(line + "\n", to: .standardOutput)
      write(status, to: .standardError)
    }
  }

  /// Writes a line to stderr.
  func message(_ line: String) {
    status.withLock { status in
      clear(status)
      write(line + "\n" + status, to: .standardError)
    }
  }

  /// Shows a line at the bottom until the next one; an empty one takes it away.
  func show(status line: String) {
    guard isInteractive else { return }
    status.withLock { status in
      clear(status)
      status = line
      write(line, to: .standardError)
    }
  }

  /// Makes writing to a pipe that nobody reads an error instead of the process's end.
  func ignoreBrokenPipes() { signal(SIGPIPE, SIG_IGN) }

  private func clear(_ status: String) {
    if !status.isEmpty { write("\r\u{1B}[K", to: .standardError) }
  }

  /// What can't be written, to a closed pipe or full disk, is lost: there is nobody to tell.
  private func write(_ text: String, to handle: FileHandle) {
    guard !text.isEmpty else { return }
    try? handle.write(contentsOf: Data(text.utf8))
  }
}
