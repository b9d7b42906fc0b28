import Foundation
import SceneModel

/// A record of a run by stage and by photo: the content of `report.json`.
package struct RunReport: Codable, Sendable {
  /// The cost of one execution of a stage, and what it recorded.
  package struct Stage: Codable, Sendable {
    package var name: String
    /// Seconds since the beginning of the run.
    package var start: Double
    /// Wall-clock time.
    package var seconds: Double
    /// User and system time of all threads.
    package var cpuSeconds: Double
    /// The part of `seconds` in which fewer than two threads were busy.
    package var serialSeconds: Double
    /// Peak resident memory of the process at the stage's end.
    package var peakMemoryBytes: Int
    /// The numbers of `StageNotes`.
    package var counts: [String: Double]
    /// Where the time went.
    package var steps: [StepCost]
  }

  /// What became of a photo.
  package struct PhotoEntry: Codable, Sendable {
    package enum Status: String, Codable, Sendable {
      /// Alignment determined its pose.
      case registered
      /// Rejected by validation.
      case rejected = "refused"
      /// Valid, but without a pose after alignment.
      case notRegistered
      /// A camera was given, but its photo is missing.
      case missing
    }

    package var name: String
    package var status: Status
    /// Why it is not registered, as a sentence.
    package var reason: String?
    /// The kind of fault of a photo that is rejected; nil if it was not.
    package var fault: RejectedPhoto.Fault?
    /// Number of features, and of the photos with which it has enough matches; nil before matching.
    package var features: Int?
    package var partners: Int?
    /// The group of photos that matches connect, from 0, the largest.
    package var group: Int?
    /// Number of its observations of sparse points; nil without a pose, as are the next two.
    package var observations: Int?
    /// Mean reprojection error in pixels, and that which 95 % of the observations don't exceed.
    package var meanResidual: Double?
    package var residual95: Double?
    /// How well its estimated mask agrees with those of all photos, 0…1: the intersection over
    /// union of the mask and the outline of their visual hull. Nil without an estimated mask.
    package var maskAgreement: Double?
    /// The share of its pixels that its mask keeps.
    package var maskShare: Double?
    /// Size in pixels, upright.
    package var width: Int?
    package var height: Int?
    /// The share of its pixels that a sharp photo with the same detail would need.
    package var sharpness: Double?
    /// How much brighter it is than the mean of the photos, in exposure values (steps of factor 2).
    package var exposure: Double?
    /// The share of the model's area that it colors more than any other photo.
    package var textureShare: Double?
    /// Index into `cameras`; nil without a pose, as are the next two.
    package var camera: Int?
    /// The projection center in the world frame.
    package var position: SIMD3<Double>?
    /// The unit quaternion w, x, y, z that rotates the camera frame (x right, y down, z forward) to
    /// the world frame.
    package var rotation: SIMD4<Double>?

    package init(name: String, status: Status, reason: String? = nil) {
      (self.name, self.status, self.reason) = (name, status, reason)
    }
  }

  /// The pairs of photos that share features.
  package struct Matches: Codable, Sendable {
    /// The file names that the pairs refer to by index.
    package var photos: [String]
    package var pairs: MatchRecord
  }

  /// The version of the report's format.
  package var version: String = "2"
  /// What ran where; nil if the caller did not say.
  package var run: RunDescription?
  /// The result in one sentence; set by `assessed`, as is the advice on photos.
  package var verdict: RunVerdict?
  /// What would make the model better.
  package var advice: [Advice] = []
  package var configuration: PipelineConfiguration
  package var stages: [Stage] = []
  package var memory = MemoryRecord()
  package var photos: [PhotoEntry] = []
  package var cameras: [CameraEntry] = []
  /// Which photos match; nil before matching.
  package var matches: Matches?
  /// In pixels; nil before alignment, as is the world frame.
  package var meanReprojectionError: Double?
  package var worldFrame: WorldFrame?
  package var tracks: TrackStatistics?
  /// Of the last model; nil before.
  package var surface: SurfaceStatistics?
  /// The reasons why the run, or a part of it, failed, as sentences.
  package var errors: [String] = []
  /// Those of the warnings because of which the model may not be what the user wants.
  package var concerns: [String] = []
  /// Warnings and additional information of all stages, as sentences.
  package var warnings: [String] = []
  package var details: [String] = []

  package init(configuration: PipelineConfiguration) {
    self.configuration = configuration
  }

  /// Adds the description of an error, unless it is present already.
  mutating func note(_ error: any Error) {
    let known = error as? any LocalizedError
    let sentence =
      error is CancellationError
      ? "The run was canceled."
      : known?.errorDescription.map { text in
        ([text] + [known?.recoverySuggestion].compactMap(\.self)).joined(separator: " ")
      } ?? String(describing: error)
    if !errors.contains(sentence) { errors.append(sentence) }
  }
}
