import Foundation
import SceneModel

/// A record of a run by stage and by photo: the content of `report.json`.
package struct RunReport: Codable, Sendable {
  package struct Stage: Codable, Sendable {
    package var name: String
    package var seconds: Double
    package var cpuSeconds: Double
    /// Peak resident memory of the process at the stage's end.
    package var peakMemoryBytes: Int
    package var counts: [String: Double]
  }

  package struct PhotoEntry: Codable, Sendable {
    package enum Status: String, Codable, Sendable {
      case registered, refused, notRegistered
      /// A camera was given, but its photo is missing.
      case missing
    }

    package var name: String
    package var status: Status
    package var reason: String?
  }

  package var version: String = "1"
  package var configuration: PipelineConfiguration
  package var stages: [Stage] = []
  package var photos: [PhotoEntry] = []
  package var meanReprojectionError: Double?
  package var worldFrame: WorldFrame?
  /// The reasons why the run, or a part of it, failed, as sentences.
  package var errors: [String] = []
  package var warnings: [String] = []
  package var details: [String] = []

  package init(configuration: PipelineConfiguration) {
    self.configuration = configuration
  }

  /// Adds the description of an error, unless it is present already.
  mutating func note(_ error: any Error) {
    let sentence =
      error is CancellationError
      ? "The run was canceled."
      : (error as? any LocalizedError)?.errorDescription ?? String(describing: error)
    if !errors.contains(sentence) { errors.append(sentence) }
  }

  /// The report as JSON with sorted keys.
  package func encoded() throws -> Data {
    let encoder = JSONEncoder()
    encoder.outputFormatting = [.prettyPrinted, .sortedKeys, .withoutEscapingSlashes]
    return try encoder.encode(self)
  }
}
