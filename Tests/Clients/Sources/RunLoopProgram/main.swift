import Foundation
import RealityKit
import os.log

// Top-level code, a task, the main run loop, and exit() inside the task.

let logger = os.Logger(subsystem: "com.example.clients", category: "RunLoopProgram")

guard CommandLine.arguments.count == 3 else {
  print("usage: RunLoopProgram <photos> <model folder>")
  exit(64)
}
guard #available(macOS 12.0, *) else {
  print("macOS 12 is needed.")
  exit(1)
}
guard PhotogrammetrySession.isSupported else {
  print("Object capture is not supported here.")
  exit(1)
}

let inputPath = (CommandLine.arguments[1] as NSString).expandingTildeInPath
let inputURL = URL(fileURLWithPath: inputPath, isDirectory: true)
let outputURL = URL(fileURLWithPath: CommandLine.arguments[2], isDirectory: true)

var configuration = PhotogrammetrySession.Configuration()
configuration.isObjectMaskingEnabled = true
configuration.featureSensitivity = .normal
if #available(macOS 14.0, *) {
  configuration.customDetailSpecification.maximumPolygonCount = 5_000
  configuration.customDetailSpecification.maximumTextureDimension = .oneK
  configuration.customDetailSpecification.outputTextureMaps = [.diffuseColor, .normal]
  configuration.customDetailSpecification.textureFormat = .jpeg(compressionQuality: 0.8)
}

let session: PhotogrammetrySession
do {
  session = try PhotogrammetrySession(input: inputURL, configuration: configuration)
} catch {
  logger.error("\(error.localizedDescription, privacy: .public)")
  exit(1)
}

let start = Date()
Task {
  do {
    for try await output in session.outputs {
      switch output {
      case .inputComplete: print("Input complete.")
      case .requestProgress(let request, fractionComplete: let fraction):
        logger.debug("\(String(describing: request)): \(fraction, format: .fixed(precision: 2))")
      case .requestProgressInfo(_, let info):
        if let stage = info.processingStage { logger.debug("Stage \(String(describing: stage))") }
        if let left = info.estimatedRemainingTime { logger.debug("\(Int(left)) s left") }
      case .requestComplete(_, .modelFile(let url)): print("Wrote \(url.path)")
      case .requestComplete: break
      case .requestError(_, let error):
        print("Failed: \(error)")
        exit(1)
      case .processingComplete:
        print("Done in \(String(format: "%.1f", Date().timeIntervalSince(start))) s.")
        exit(0)
      case .processingCancelled: exit(2)
      case .invalidSample(let id, let reason): logger.warning("Sample \(id): \(reason)")
      case .skippedSample(let id): logger.warning("Sample \(id) was skipped.")
      case .automaticDownsampling: logger.notice("Downsampling.")
      case .stitchingIncomplete: logger.notice("Stitching is incomplete.")
      @unknown default: break
      }
    }
  } catch {
    print("Error: \(error)")
    exit(1)
  }
}

do {
  try session.process(requests: [.modelFile(url: outputURL, detail: .custom)])
} catch {
  print("Could not process: \(error)")
  exit(1)
}
RunLoop.main.run()
