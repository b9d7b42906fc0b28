import Foundation
import SceneModel

/// The distance of a surface or cloud from ground truth, in units of the reference.
package struct SurfaceScores: Codable, Hashable, Sendable {
  /// The scores at one distance threshold, from 0 to 1.
  package struct AtThreshold: Codable, Hashable, Sendable {
    /// Distance in units of the reference.
    package var threshold: Double
    /// The fraction of the result within this distance of the reference (accuracy).
    package var precision: Double
    /// The fraction of the reference within this distance of the result (completeness).
    package var recall: Double
    /// The harmonic mean of precision and recall.
    package var fScore: Double
  }

  /// Number of compared samples of the result and of the reference.
  package var resultSamples: Int
  package var referenceSamples: Int
  package var thresholds: [AtThreshold]
  /// Mean distance from the result to the reference, and from the reference to the result;
  /// distances are truncated at `maximumDistance`.
  package var accuracy: Double
  package var completeness: Double
  /// The mean of accuracy and completeness (Chamfer distance).
  package var chamfer: Double
  package var maximumDistance: Double
}
