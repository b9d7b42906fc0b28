import Foundation

/// A line of `--json`.
package struct RunEvent: Codable, Equatable, Sendable {
  /// The kind of event, such as `progress`.
  package var event: String
  /// Name of the dataset, in a batch.
  package var dataset: String?
  /// Share of the run that is done, 0…1.
  package var fraction: Double?
  /// The current stage.
  package var stage: RunStage?
  /// Estimated time left.
  package var remainingSeconds: Double?
  /// Index of the photo in the session.
  package var sample: Int?
  /// Why a photo is not used.
  package var reason: String?
  /// What was written: model, preview, poses, pointCloud or report.
  package var kind: String?
  /// The file or folder that was written or would be written.
  package var path: String?
  /// A warning, or a failure with its remedy.
  package var message: String?
  /// Of a failure: whether another attempt may succeed.
  package var isTransient: Bool?
  /// Duration of the run or dataset.
  package var seconds: Double?
  /// Number of photos that are used.
  package var photos: Int?
  /// Number of photos with a pose.
  package var registered: Int?
  /// Number of triangles of the model.
  package var triangles: Int?
  /// Of a complete run: what its report says about the model.
  package var quality: RunQuality?
  /// Of a plan: the usual duration of the run.
  package var expectedSeconds: Double?
  /// Of a plan: the usual upper bound of the memory.
  package var memoryBytes: Int?
  /// Of a plan: the maximum size of the model.
  package var diskBytes: Int?
  /// Of a dataset: how its processing ended.
  package var status: DatasetStatus?
  /// Of a dataset: the number of runs.
  package var attempts: Int?
  /// Of a batch: the number of datasets.
  package var datasets: Int?
  /// Of a batch: the number of datasets with that status, as for the next three.
  package var done: Int?
  package var skipped: Int?
  package var failed: Int?
  package var cancelled: Int?
  /// Of a batch with a baseline: the number of datasets that got worse.
  package var worse: Int?

  /// Creates an event of the kind `event`, whose fields `fill` sets.
  package init(_ event: String, _ fill: (inout RunEvent) -> Void = { _ in }) {
    self.event = event
    fill(&self)
  }

  /// What an event `progress` says.
  package var progress: RunProgress {
    RunProgress(fraction: fraction ?? 0, stage: stage, remaining: remainingSeconds)
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
