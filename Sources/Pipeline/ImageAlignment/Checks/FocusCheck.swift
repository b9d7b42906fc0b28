import Foundation
import SceneModel

/// Checks that the photos are aligned by what they are aimed at.
///
/// Where an object moves in front of surroundings with more texture, photos may be aligned by
/// these: their features are then observations of points, but hardly any of those around the point
/// that the optical axes meet at.
struct FocusCheck: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Radius of the focus, as a share of a photo's longer side, and the factor by which that of
    /// its surroundings is larger.
    var radius = 0.12
    var surroundingsFactor = 2.5
    /// Minimum number of features in the focus of the median photo; fewer say nothing.
    var minimumFeatures = 20.0
    /// Minimum share of the features in the focus that are observations of points, relative to that
    /// of the surroundings.
    var minimumRatio = 0.25
  }

  /// The shares of features that are observations of points, in the median photo.
  struct Findings: Equatable, Sendable {
    /// The number of features in the focus.
    var features = 0.0
    var focusShare = 0.0
    var surroundingsShare = 0.0
  }

  var options = Options()

  /// Records the findings, and a doubt if the photos are aligned by the surroundings.
  func run(_ reconstruction: Reconstruction, _ features: [FeatureSet], _ notes: StageNotes) {
    guard let findings = findings(reconstruction, features) else { return }
    notes.record("focusFeatures", findings.features)
    notes.record("focusShare", findings.focusShare)
    notes.record("surroundingsShare", findings.surroundingsShare)
    guard findings.features >= options.minimumFeatures,
      findings.focusShare < options.minimumRatio * findings.surroundingsShare
    else { return }
    notes.doubt(
      "The photos were aligned by the surroundings of what they are aimed at, which hardly matches "
        + "between photos: it moves, is shiny or transparent. Cover what is around it with a plain "
        + "cloth, or give masks.")
  }

  /// Nil if the optical axes don't determine a focus.
  func findings(_ reconstruction: Reconstruction, _ features: [FeatureSet]) -> Findings? {
    var depths = [[Double]](repeating: [], count: reconstruction.photos.count)
    var isObservation = features.map { [Bool](repeating: false, count: $0.count) }
    for point in reconstruction.points {
      for observation in point.track {
        let photo = observation.photo.index
        if let pose = reconstruction.poses[photo] {
          depths[photo].append((pose * point.position).z)
        }
        if observation.feature >= 0 { isObservation[photo][Int(observation.feature)] = true }
      }
    }
    guard let focus = ViewFocus(reconstruction, depths: depths.map(\.upperMedian)) else {
      return nil
    }
    var (counts, inner, outer): ([Double], [Double], [Double]) = ([], [], [])
    for photo in reconstruction.registered {
      guard let pose = reconstruction.poses[photo.index], (pose * focus.point).z > 0 else {
        continue
      }
      let camera = reconstruction.camera(of: photo)
      let center = camera.project(pose * focus.point)
      let radius = options.radius * Double(max(camera.width, camera.height))
      let (set, isUsed) = (features[photo.index], isObservation[photo.index])
      let distances = set.positions.map { (SIMD2<Double>($0) - center).length / radius }
      let near = isUsed.indices.filter { distances[$0] < 1 }
      let far = isUsed.indices.filter {
        distances[$0] >= 1 && distances[$0] < options.surroundingsFactor
      }
      counts.append(Double(near.count))
      if !near.isEmpty { inner.append(Double(near.count { isUsed[$0] }) / Double(near.count)) }
      if !far.isEmpty { outer.append(Double(far.count { isUsed[$0] }) / Double(far.count)) }
    }
    return Findings(
      features: counts.upperMedian ?? 0, focusShare: inner.upperMedian ?? 0,
      surroundingsShare: outer.upperMedian ?? 0)
  }
}
