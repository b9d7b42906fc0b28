import Foundation

/// A line of `--json`.
package struct RunEvent: Codable, Equatable, Sendable {
  package var event: String
  /// Name of the dataset, in a batch.
  package var dataset: String?
  package var fraction: Double?
  package var stage: RunStage?
  package var remainingSeconds: Double?
  /// Index of the photo in the session.
  package var sample: Int?
  package var reason: String?
  package var kind: String?
  package var path: String?
  package var message: String?
  /// Of a failure: whether another attempt may succeed.
  package var isTransient: Bool?
  package var seconds: Double?
  package var photos: Int?
  /// Number of photos with a pose.
  package var registered: Int?
  package var triangles: Int?
  package var expectedSeconds: Double?
  package var memoryBytes: Int?
  package var diskBytes: Int?
  package var status: DatasetStatus?
  package var attempts: Int?
  package var datasets: Int?
  package var done: Int?
  package var skipped: Int?
  package var failed: Int?
  package var cancelled: Int?

  package init(_ event: String, _ fill: (inout RunEvent) -> Void = { _ in }) {
    self.event = event
    fill(&self)
  }

  static func progress(_ progress: RunProgress) -> RunEvent {
    RunEvent("progress") {
      $0.fraction = progress.fraction
      $0.stage = progress.stage
      $0.remainingSeconds = progress.remaining
    }
  }

  /// The event as one line with sorted keys.
  package var line: String {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.sortedKeys, .withoutEscapingSlashes]
    let data = (try? encoder.encode(self)) ?? Data()
    return String(decoding: data, as: UTF8.self)
  }

  /// Writes the line to stdout.
  package func write() { Terminal.shared.result(line) }
}

extension RunEvent {
  /// Parses a line; nil if it is not an event.
  package init?(line: some Collection<UInt8>) {
    guard let event = try? JSONDecoder().decode(Self.self, from: Data(line)) else { return nil }
    self = event
  }
}
