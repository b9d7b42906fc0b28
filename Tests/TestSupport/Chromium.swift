import Foundation

/// A headless Chromium, controlled by the DevTools protocol over two pipes.
package final class Chromium {
  package enum Failure: Error {
    /// The browser ended, or gave no answer in time.
    case noAnswer(to: String)
    case exception(String)
  }

  /// The program; nil if it isn't installed.
  package static let program: URL? = {
    let folders = (ProcessInfo.processInfo.environment["PATH"] ?? "").split(separator: ":")
    return ["chromium", "chromium-browser", "google-chrome"].lazy.flatMap { name in
      folders.map { URL(fileURLWithPath: "\($0)/\(name)") }
    }.first { FileManager.default.isExecutableFile(atPath: $0.path) }
  }()

  /// Seconds until an answer must have come. Chosen: a hundred times what it takes.
  private static let patience = 60.0

  private let process = Process()
  private let input = Pipe()
  private let output = Pipe()
  private let profile: TemporaryFolder
  private var received: [UInt8] = []
  private var lastID = 0
  /// All events so far.
  private var events: [[String: Any]] = []
  private var session: String?

  /// Starts the browser with a page of `width` × `height` pixels.
  package init(width: Int = 1280, height: Int = 900, flags: [String] = []) throws {
    profile = try TemporaryFolder()
    guard let program = Self.program else { throw Failure.noAnswer(to: "start") }
    process.executableURL = URL(fileURLWithPath: "/bin/sh")
    // The browser reads from descriptor 3 and writes to 4.
    process.arguments =
      [
        "-c", "exec \"$@\" 3<&0 4>&1 >/dev/null 2>&1", "sh", program.path, "--headless",
        "--remote-debugging-pipe", "--enable-unsafe-swiftshader", "--disable-dev-shm-usage",
        "--user-data-dir=\(profile.url.path)", "--window-size=\(width),\(height)",
      ] + (geteuid() == 0 ? ["--no-sandbox"] : []) + flags
    process.standardInput = input
    process.standardOutput = output
    process.standardError = FileHandle.nullDevice
    try process.run()
    let target = try send("Target.createTarget", ["url": "about:blank"])
    session =
      try send(
        "Target.attachToTarget", ["targetId": target["targetId"] ?? "", "flatten": true])[
        "sessionId"] as? String
    for domain in ["Page", "Runtime", "Log", "Network"] { try send("\(domain).enable") }
  }

  deinit {
    process.terminate()
    process.waitUntilExit()
  }

  // MARK: - Protocol

  /// Sends a command and returns its result.
  @discardableResult
  package func send(_ method: String, _ parameters: [String: Any] = [:]) throws -> [String: Any] {
    lastID += 1
    var message: [String: Any] = ["id": lastID, "method": method, "params": parameters]
    message["sessionId"] = session
    input.fileHandleForWriting.write(
      try JSONSerialization.data(withJSONObject: message) + [0])
    let end = Date(timeIntervalSinceNow: Self.patience)
    while let answer = try receive(until: end) {
      guard answer["id"] as? Int == lastID else {
        events.append(answer)
        continue
      }
      guard let result = answer["result"] as? [String: Any] else {
        throw Failure.exception("\(answer["error"] ?? "")")
      }
      return result
    }
    throw Failure.noAnswer(to: method)
  }

  /// The next message; nil if there is none until `end`.
  private func receive(until end: Date) throws -> [String: Any]? {
    while true {
      if let stop = received.firstIndex(of: 0) {
        let message = Data(received[..<stop])
        received.removeSubrange(...stop)
        return try JSONSerialization.jsonObject(with: message) as? [String: Any]
      }
      let descriptor = output.fileHandleForReading.fileDescriptor
      var ready = pollfd(fd: descriptor, events: Int16(POLLIN), revents: 0)
      let milliseconds = Int32(max(0, end.timeIntervalSinceNow * 1000))
      guard poll(&ready, 1, milliseconds) > 0 else { return nil }
      let data = output.fileHandleForReading.availableData
      guard !data.isEmpty else { return nil }
      received += data
    }
  }

  // MARK: - Page

  /// Opens a file and waits until the page says that it is complete. Returns the seconds that took.
  package func open(_ file: URL) throws -> Double {
    events = []
    let start = Date()
    try send("Page.navigate", ["url": file.absoluteString])
    while try evaluate("document.documentElement?.dataset.ready") as? String != "1" {
      guard start.timeIntervalSinceNow > -Self.patience else {
        throw Failure.noAnswer(to: "data-ready of \(file.lastPathComponent)")
      }
      usleep(20_000)
    }
    return -start.timeIntervalSinceNow
  }

  /// The value of a JavaScript expression, which may be a promise.
  @discardableResult
  package func evaluate(_ expression: String) throws -> Any? {
    let result = try send(
      "Runtime.evaluate",
      ["expression": expression, "awaitPromise": true, "returnByValue": true])
    if let details = result["exceptionDetails"] as? [String: Any] {
      throw Failure.exception("\(expression): \(details)")
    }
    return (result["result"] as? [String: Any])?["value"]
  }

  /// Presses and releases a key, such as `ArrowLeft`.
  package func press(_ key: String) throws {
    for type in ["keyDown", "keyUp"] {
      try send("Input.dispatchKeyEvent", ["type": type, "key": key, "code": key])
    }
  }

  /// Makes the page light or dark.
  package func prefer(_ scheme: String) throws {
    try send(
      "Emulation.setEmulatedMedia",
      ["features": [["name": "prefers-color-scheme", "value": scheme]]])
  }

  /// What went wrong since the page was opened: exceptions, console errors and blocked loads.
  package var complaints: [String] {
    events.compactMap { event in
      let parameters = event["params"] as? [String: Any] ?? [:]
      switch event["method"] as? String {
      case "Runtime.exceptionThrown": return "\(parameters)"
      case "Runtime.consoleAPICalled":
        return ["error", "assert"].contains(parameters["type"] as? String) ? "\(parameters)" : nil
      case "Log.entryAdded":
        let entry = parameters["entry"] as? [String: Any] ?? [:]
        return entry["level"] as? String == "error" ? "\(entry)" : nil
      default: return nil
      }
    }
  }

  /// The addresses that were requested, except those inside the page.
  package var requests: [String] {
    events.compactMap { event in
      guard event["method"] as? String == "Network.requestWillBeSent",
        let request = (event["params"] as? [String: Any])?["request"] as? [String: Any],
        let url = request["url"] as? String
      else { return nil }
      return ["data:", "blob:"].contains { url.hasPrefix($0) } ? nil : url
    }
  }
}
