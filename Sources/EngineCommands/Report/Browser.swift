import Foundation

/// The user's web browser.
enum Browser {
  /// Opens a page, if the session has a screen and the system knows a browser; else does nothing.
  static func open(_ page: URL) {
    let environment = ProcessInfo.processInfo.environment
    let hasScreen = ["DISPLAY", "WAYLAND_DISPLAY"].contains { environment[$0]?.isEmpty == false }
    let opener = (environment["PATH"] ?? "").split(separator: ":")
      .map { URL(fileURLWithPath: "\($0)/xdg-open") }
      .first { FileManager.default.isExecutableFile(atPath: $0.path) }
    guard hasScreen, let opener else { return }
    let process = Process()
    process.executableURL = opener
    process.arguments = [page.path]
    process.standardInput = FileHandle.nullDevice
    process.standardOutput = FileHandle.nullDevice
    process.standardError = FileHandle.nullDevice
    try? process.run()
  }
}
