import Foundation
import SceneModel
import SharedCommands
import Synchronization

/// A `reconstruct` in a separate process, so that a crash or lack of memory does not affect others.
///
/// Closing its standard input stops it; the kernel does so when this process is killed.
final class ChildRun: Sendable {
  enum Outcome: Equatable {
    /// With its exit code and its last event.
    case ended(code: Int32, last: RunEvent?)
    case killed(signal: Int32)
    case notStarted(reason: String)
  }

  /// Serializes starts, so that no child inherits a descriptor created for another.
  private static let starting = Locked(())

  /// With huge pages for large arrays, which glibc reads when a process starts. Measured: the chunk
  /// `tileBase` of the town of 1000 photos takes 121 instead of 137 CPU seconds
  /// (docs/experiments/2026-11-scale.md, Chunks).
  private static let environment = ProcessInfo.processInfo.environment
    .merging(["GLIBC_TUNABLES": "glibc.malloc.hugetlb=1"]) { given, _ in given }

  private let arguments: [String]
  private let directory: URL?
  private let log: URL
  private let input = Locked<Pipe?>(nil)
  private let isStopped = Atomic<Bool>(false)

  /// `arguments` follow the program's name; stderr goes to the file `log`. Relative paths start
  /// from `directory`, or from the current folder.
  init(_ arguments: [String], in directory: URL? = nil, log: URL) {
    (self.arguments, self.directory, self.log) = (arguments, directory, log)
  }

  /// Runs to the end and calls `onEvent` with each event, on a separate thread.
  func run(_ onEvent: @escaping @Sendable (RunEvent) -> Void) async -> Outcome {
    await withCheckedContinuation { continuation in
      Thread.detachNewThread { continuation.resume(returning: self.work(onEvent)) }
    }
  }

  /// Requests a stop; the process keeps its finished stages.
  func stop() {
    isStopped.store(true, ordering: .sequentiallyConsistent)
    input.withLock { try? $0?.fileHandleForWriting.close() }
  }

  private func work(_ onEvent: (RunEvent) -> Void) -> Outcome {
    let process = Process()
    let output: FileHandle
    do {
      output = try start(process)
    } catch {
      return .notStarted(reason: error.localizedDescription)
    }
    if isStopped.load(ordering: .sequentiallyConsistent) { stop() }
    let last = Self.read(output, onEvent)
    process.waitUntilExit()
    stop()
    return process.terminationReason == .uncaughtSignal
      ? .killed(signal: process.terminationStatus)
      : .ended(code: process.terminationStatus, last: last)
  }

  private func start(_ process: Process) throws -> FileHandle {
    process.executableURL = URL(fileURLWithPath: "/proc/self/exe")
    process.arguments = arguments
    process.environment = Self.environment
    if let directory { process.currentDirectoryURL = directory }
    try Data().write(to: log)
    process.standardError = try FileHandle(forWritingTo: log)
    return try Self.starting.withLock { _ in
      let (input, output) = (Pipe(), Pipe())
      for handle in [input.fileHandleForWriting, output.fileHandleForReading] {
        _ = fcntl(handle.fileDescriptor, F_SETFD, FD_CLOEXEC)
      }
      process.standardInput = input
      process.standardOutput = output
      try process.run()
      self.input.withLock { $0 = input }
      return output.fileHandleForReading
    }
  }

  /// Reads events until the other end is closed; returns the last one.
  private static func read(
    _ handle: FileHandle, _ onEvent: (RunEvent) -> Void
  ) -> RunEvent? {
    var rest: [UInt8] = []
    var last: RunEvent?
    while case let data = handle.availableData, !data.isEmpty {
      rest += data
      while let end = rest.firstIndex(of: UInt8(ascii: "\n")) {
        if let event = RunEvent(line: rest[..<end]) {
          last = event
          onEvent(event)
        }
        rest.removeSubrange(...end)
      }
    }
    return last
  }
}
