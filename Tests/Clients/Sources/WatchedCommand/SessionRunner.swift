import CoreGraphics
import Foundation
import RealityKit
import os
import simd

/// Runs sessions for a command: a class with callbacks, a timeout, and a result for each request.
final class SessionRunner: NSObject {
  enum Failure: Error, CustomStringConvertible {
    case timedOut(after: TimeInterval)
    case request(PhotogrammetrySession.Request, Error)
    case session(PhotogrammetrySession.Error)

    var description: String {
      switch self {
      case .timedOut(let seconds): return "timed out after \(seconds) s"
      case .request(let request, let error): return "\(request): \(error.localizedDescription)"
      case .session(let error): return error.localizedDescription
      }
    }
  }

  private let session: PhotogrammetrySession
  private let signposts = os.Logger(subsystem: "com.example.clients", category: "SessionRunner")
  private(set) var posesByID: [Int: simd_float4x4] = [:]
  private(set) var box = BoundingBox.empty
  var onProgress: ((Double) -> Void)?

  init(input: URL, configuration: PhotogrammetrySession.Configuration) throws {
    do {
      session = try PhotogrammetrySession(input: input, configuration: configuration)
    } catch let error as PhotogrammetrySession.Error {
      throw Failure.session(error)
    }
    super.init()
  }

  func run(_ requests: [PhotogrammetrySession.Request], timeout: TimeInterval) async throws {
    let start = CFAbsoluteTimeGetCurrent()
    let session = self.session
    let watchdog = Task.detached(priority: .background) {
      try await Task.sleep(nanoseconds: UInt64(timeout * 1_000_000_000))
      session.cancel()
    }
    defer { watchdog.cancel() }
    try session.process(requests: requests)
    for try await output in session.outputs {
      switch output {
      case .requestComplete(let request, let result): store(result, of: request)
      case .requestProgress(_, fractionComplete: let fraction): onProgress?(fraction)
      case .requestProgressInfo(let request, let info):
        signposts.debug(
          """
          \(String(describing: request)): \
          \(String(describing: info.processingStage), privacy: .public)
          """
        )
      case .requestError(let request, let error): throw Failure.request(request, error)
      case .processingCancelled: throw Failure.timedOut(after: timeout)
      case .processingComplete:
        signposts.info("took \(CFAbsoluteTimeGetCurrent() - start, format: .fixed(precision: 2)) s")
        return
      case .inputComplete, .automaticDownsampling, .stitchingIncomplete: break
      case .invalidSample(let id, _), .skippedSample(let id): signposts.warning("sample \(id)")
      @unknown default: break
      }
    }
  }

  private func store(
    _ result: PhotogrammetrySession.Result, of request: PhotogrammetrySession.Request
  ) {
    switch (request, result) {
    case (.poses, .poses(let poses)):
      posesByID = poses.posesBySample.mapValues { $0.transform.matrix }
    case (.bounds, .bounds(let bounds)):
      box = bounds
    case (.modelFile(_, let detail, _), .modelFile(let url)):
      print("\(detail): \(url.lastPathComponent)")
    default: break
    }
  }
}

/// A pose in a form that other programs read.
struct Frame: Codable {
  var id: Int
  var matrix: [[Float]]

  init(id: Int, transform: simd_float4x4) {
    self.id = id
    let c = transform.columns
    matrix = [c.0, c.1, c.2, c.3].map { [$0.x, $0.y, $0.z, $0.w] }
  }
}
