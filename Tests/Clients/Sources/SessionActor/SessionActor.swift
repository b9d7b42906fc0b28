import Foundation
import RealityKit
import os

/// An actor that owns a session and delivers results by continuation, by completion handler and as
/// a stream.
///
///     SessionActor <photos>
actor Scanner {
  enum Step: Sendable {
    case fraction(Double)
    case stage(String, left: TimeInterval?)
  }

  struct Canceled: LocalizedError {
    var errorDescription: String? { "The scan was canceled." }
  }

  private let session: PhotogrammetrySession
  private let signposter = OSSignposter(subsystem: "com.example.clients", category: "Scanner")
  private(set) var finished = 0

  init(photos: URL) throws {
    var configuration = PhotogrammetrySession.Configuration()
    configuration.sampleOrdering = .sequential
    session = try PhotogrammetrySession(input: photos, configuration: configuration)
  }

  /// The steps of a run until it completes.
  nonisolated func steps() -> AsyncThrowingStream<Step, any Error> {
    AsyncThrowingStream { continuation in
      let outputs = session.outputs
      let task = Task {
        do {
          for try await output in outputs {
            switch output {
            case .requestProgress(_, let fraction): continuation.yield(.fraction(fraction))
            case .requestProgressInfo(_, let info):
              let stage = info.processingStage.map { String(describing: $0) } ?? "begin"
              continuation.yield(.stage(stage, left: info.estimatedRemainingTime))
            case .processingCancelled: throw Canceled()
            case .processingComplete:
              continuation.finish()
              return
            default: continue
            }
          }
          continuation.finish()
        } catch { continuation.finish(throwing: error) }
      }
      continuation.onTermination = { @Sendable _ in task.cancel() }
    }
  }

  /// The first result of one request.
  func result(
    of request: PhotogrammetrySession.Request
  ) async throws -> PhotogrammetrySession.Result {
    let interval = signposter.beginInterval("request", id: signposter.makeSignpostID())
    defer { signposter.endInterval("request", interval) }
    let result = try await withCheckedThrowingContinuation { continuation in
      run(request) { continuation.resume(with: $0) }
    }
    finished += 1
    return result
  }

  private func run(
    _ request: PhotogrammetrySession.Request,
    completion: @escaping @Sendable (Result<PhotogrammetrySession.Result, any Error>) -> Void
  ) {
    let outputs = session.outputs
    Task.detached(priority: .userInitiated) {
      var outcome: Result<PhotogrammetrySession.Result, any Error> = .failure(Canceled())
      do {
        for try await output in outputs {
          switch output {
          case .requestComplete(request, let result): outcome = .success(result)
          case .requestError(request, let error): outcome = .failure(error)
          case .processingComplete, .processingCancelled: return completion(outcome)
          default: break
          }
        }
        completion(outcome)
      } catch { completion(.failure(error)) }
    }
    do { try session.process(requests: [request]) } catch { completion(.failure(error)) }
  }
}

@main
enum SessionActor {
  static func main() async {
    let logger = Logger(subsystem: "com.example.clients", category: "SessionActor")
    do {
      let scanner = try Scanner(
        photos: URL(fileURLWithPath: CommandLine.arguments[1], isDirectory: true))
      async let stages = watch(scanner)
      guard case .poses(let poses) = try await scanner.result(of: .poses) else { exit(2) }
      let heights = poses.posesBySample.values.map(\.translation.y)
      let seen = try await stages
      logger.info(
        "height \(heights.max() ?? 0, format: .fixed(precision: 3), align: .right(columns: 8))")
      print("placed \(heights.count) in \(seen.count) stages, finished \(await scanner.finished)")
    } catch let error as PhotogrammetrySession.Error {
      logger.critical("\(error.localizedDescription, privacy: .public)")
      exit(1)
    } catch {
      print(error.localizedDescription)
      exit(1)
    }
  }

  static func watch(_ scanner: Scanner) async throws -> Set<String> {
    var stages: Set<String> = []
    for try await step in scanner.steps() {
      if case .stage(let name, left: _) = step { stages.insert(name) }
    }
    return stages
  }
}
