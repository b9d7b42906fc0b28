import Dispatch
import Foundation
import RealityFoundation
import simd

// A semaphore instead of a run loop, a detached task, a queue timeout, and every kind of result.

final class Results: @unchecked Sendable {
  private let lock = NSLock()
  private var bounds: BoundingBox?
  private var cameras = 0
  private var points = 0
  private var error: String?

  func take(_ result: PhotogrammetrySession.Result) {
    lock.lock()
    defer { lock.unlock() }
    switch result {
    case .modelFile(let url): print("model \((url.path as NSString).lastPathComponent)")
    case .modelEntity: break
    case .bounds(let box): bounds = box
    case .pointCloud(let cloud): points = cloud.points.count
    case .poses(let poses):
      cameras = poses.posesBySample.filter { $0.value.rotation.real != 2 }.count
    @unknown default: fatalError("an unknown result")
    }
  }

  func fail(_ error: any Error) {
    lock.lock()
    defer { lock.unlock() }
    self.error = String(describing: error)
  }

  func summary() -> String {
    lock.lock()
    defer { lock.unlock() }
    if let error { return "failed: \(error)" }
    let extents = bounds?.extents ?? SIMD3<Float>(repeating: 0)
    return "\(cameras) cameras, \(points) points, diagonal \(simd_length(extents))"
  }
}

func reconstruct(_ photos: URL, into results: Results) -> DispatchTimeoutResult {
  let semaphore = DispatchSemaphore(value: 0)
  do {
    let session = try PhotogrammetrySession(input: photos)
    let outputs = session.outputs
    Task.detached {
      do {
        for try await output in outputs {
          if case .requestComplete(_, let result) = output { results.take(result) }
          if case .requestError(_, let error) = output { results.fail(error) }
          if case .processingComplete = output { semaphore.signal() }
          if case .processingCancelled = output { semaphore.signal() }
        }
      } catch {
        results.fail(error)
        semaphore.signal()
      }
    }
    try session.process(requests: [.poses, .bounds, .pointCloud])
    return semaphore.wait(timeout: .now() + .seconds(600))
  } catch {
    results.fail(error)
    return .success
  }
}

let folder = URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true)
let results = Results()
guard reconstruct(folder, into: results) == .success else {
  FileHandle.standardError.write(Data("timed out\n".utf8))
  exit(3)
}
print(results.summary())
exit(results.summary().hasPrefix("failed") ? 1 : 0)
