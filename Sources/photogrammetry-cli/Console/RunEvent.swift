import Foundation

/// A line of `--json`.
struct RunEvent: Codable, Equatable {
  var event: String
  /// The dataset of a batch.
  var dataset: String?
  var fraction: Double?
  var stage: RunStage?
  var remainingSeconds: Double?
  var sample: Int?
  var reason: String?
  var kind: String?
  var path: String?
  var message: String?
  /// Of a failure, whether its cause may be gone at another time.
  var mayPass: Bool?
  var seconds: Double?
  var photos: Int?
  var registered: Int?
  var triangles: Int?
  var status: BatchEntry.Status?
  var attempts: Int?
  var datasets: Int?
  var done: Int?
  var skipped: Int?
  var failed: Int?
  var cancelled: Int?

  /// The lines of `reconstruct`, as a section of help.
  static let help = """
    EVENTS (with --json, one JSON object a line on stdout, and nothing else)
      progress             fraction, stage, remainingSeconds once it is known
      inputComplete        all photos were read
      invalidSample        sample, reason: a photo that is not used
      skippedSample        sample: a photo that could not be placed
      automaticDownsampling, stitchingIncomplete
      warning              message
      written              kind (model, preview, poses, pointCloud, report), path
    and one of these as the last:
      complete             seconds, photos, registered, triangles
      failed               message with what to do, mayPass, seconds
      cancelled            message, seconds

    """

  static func progress(_ progress: RunProgress) -> RunEvent {
    RunEvent(
      event: "progress", fraction: progress.fraction, stage: progress.stage,
      remainingSeconds: progress.remaining)
  }

  /// The event as one line with sorted keys.
  var line: String {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.sortedKeys, .withoutEscapingSlashes]
    let data = (try? encoder.encode(self)) ?? Data()
    return String(decoding: data, as: UTF8.self)
  }

  func write() { Terminal.shared.result(line) }
}

extension RunEvent {
  /// Reads a line; nil where it is none.
  init?(line: some Collection<UInt8>) {
    guard let event = try? JSONDecoder().decode(Self.self, from: Data(line)) else { return nil }
    self = event
  }
}
