import Foundation
import RealityFoundation
import SceneModel

/// Sessions on one folder of photos that are canceled at random times, with their measurements.
struct CancelTrial {
  private struct Cancel {
    var stage: String
    var seconds: Double
  }

  private let photos: URL
  private let detail: PhotogrammetrySession.Request.Detail
  private let folder: URL
  private var generator: SplitMix64
  private var reference = Data()
  private var referenceSeconds = 0.0
  private var cancels: [Cancel] = []
  private var models = 0

  /// Works in a folder, which must exist.
  init(
    photos: URL, detail: PhotogrammetrySession.Request.Detail, folder: URL, generator: SplitMix64
  ) {
    (self.photos, self.detail, self.folder, self.generator) = (photos, detail, folder, generator)
  }

  var count: Int { cancels.count }

  private var model: URL { folder.appendingPathComponent("model.usdz") }
  private var checkpoint: URL { folder.appendingPathComponent("checkpoint") }

  /// Makes the reference model without a cancellation.
  mutating func makeReference() async throws {
    let start = ContinuousClock.now
    guard try await run(session(), cancelingAfter: nil) == .complete else {
      throw TrialError.failed
    }
    referenceSeconds = seconds(since: start)
    reference = try Data(contentsOf: model)
    try clear()
    print("An uninterrupted session takes \(format(referenceSeconds)) s.")
  }

  /// Makes a model with at most `limit` cancellations on the way; every second attempt reuses the
  /// session.
  mutating func makeWithCancellations(atMost limit: Int) async throws {
    var session = try session()
    for attempt in 0...limit {
      if attempt.isMultiple(of: 2) { session = try self.session() }
      // A resumed run is shorter, so most times are early.
      let pause = Double.random(in: 0..<0.6 * referenceSeconds, using: &generator)
      switch try await run(session, cancelingAfter: attempt < limit ? pause : nil) {
      case .canceled: continue
      case .failed: throw TrialError.failed
      case .complete: break
      }
      break
    }
    models += 1
    guard try Data(contentsOf: model) == reference else { throw TrialError.differs }
    try clear()
  }

  func printSummary() {
    for (stage, cancels) in Dictionary(grouping: cancels, by: \.stage).sorted(by: {
      $0.key < $1.key
    }) {
      let slowest = cancels.map(\.seconds).max() ?? 0
      print("\(stage): \(cancels.count) cancellations, the slowest took \(format(slowest)) s")
    }
    let slow = cancels.filter { $0.seconds > 1 }.count
    print("\(count) cancellations, \(slow) took more than 1 s; \(models) models, all identical.")
  }

  private func session() throws -> PhotogrammetrySession {
    try PhotogrammetrySession(
      input: photos, configuration: .init(checkpointDirectory: checkpoint))
  }

  /// Processes until the session ends by itself or is canceled.
  private mutating func run(
    _ session: PhotogrammetrySession, cancelingAfter pause: Double?
  ) async throws -> SessionObserver.Ending {
    let observer = SessionObserver()
    let outputs = session.outputs
    try session.process(requests: [.modelFile(url: model, detail: detail)])
    let ending = Task { try await observer.ending(of: outputs) }
    guard let pause else { return try await ending.value }
    try await Task.sleep(for: .seconds(pause))
    let (stage, start) = (observer.stage, ContinuousClock.now)
    session.cancel()
    let value = try await ending.value
    if value == .canceled {
      cancels.append(Cancel(stage: stage, seconds: seconds(since: start)))
      print(
        """
        \(count): after \(format(pause)) s, in \(stage), ended \
        \(format(seconds(since: start))) s later
        """
      )
    }
    return value
  }

  private func clear() throws {
    for url in [checkpoint, model] { try FileManager.default.removeItem(at: url) }
  }
}

enum TrialError: LocalizedError {
  case failed, differs

  var errorDescription: String? {
    switch self {
    case .failed: "A session ended in neither processingComplete nor processingCancelled."
    case .differs: "A model differs from that of the uninterrupted session."
    }
  }
}

private func seconds(since start: ContinuousClock.Instant) -> Double {
  (ContinuousClock.now - start) / .seconds(1)
}

private func format(_ seconds: Double) -> String { String(format: "%.3f", seconds) }
