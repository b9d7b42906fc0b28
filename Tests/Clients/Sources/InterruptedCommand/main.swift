import Foundation
import OSLog
import RealityKit

// Ends cleanly when interrupted; interrupts itself once processing has begun.
//
//     InterruptedCommand <photos> <model.usdz>

let log = OSLog(subsystem: "com.example.clients", category: "InterruptedCommand")
let memory = ProcessInfo.processInfo.physicalMemory
os_log(
  "%{public}@ has %d processors and %{public}@", log: log, type: .default,
  ProcessInfo.processInfo.hostName, ProcessInfo.processInfo.activeProcessorCount,
  ByteCountFormatter.string(fromByteCount: Int64(clamping: memory), countStyle: .memory))

let photos = URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true)
let model = URL(fileURLWithPath: CommandLine.arguments[2])
guard let session = try? PhotogrammetrySession(input: photos) else {
  os_log("%{public}@ has no photos", log: log, type: .error, photos.path)
  exit(66)
}

// The handlers receive the signals instead of the default action, which ends the program.
let handlers = [SIGINT, SIGTERM].map { number in
  signal(number, SIG_IGN)
  let source = DispatchSource.makeSignalSource(signal: number, queue: .main)
  source.setEventHandler { session.cancel() }
  source.resume()
  return source
}

Task {
  do {
    for try await output in session.outputs {
      switch output {
      case .inputComplete: kill(getpid(), SIGINT)
      case .processingCancelled:
        print("canceled by one of \(handlers.count) signals, processing \(session.isProcessing)")
        exit(0)
      case .requestError(_, let error):
        os_log(.fault, log: log, "\(error.localizedDescription, privacy: .public)")
      case .processingComplete: exit(2)
      case .requestComplete, .requestProgress, .requestProgressInfo: continue
      case .invalidSample, .skippedSample, .automaticDownsampling, .stitchingIncomplete: continue
      @unknown default: continue
      }
    }
  } catch { exit(3) }
}

DispatchQueue.main.async {
  do {
    try session.process(requests: [.modelFile(url: model, detail: .full)])
  } catch {
    os_log("%{public}@", log: log, type: .error, String(describing: error))
    exit(74)
  }
}
dispatchMain()
