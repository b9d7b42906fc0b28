import Foundation
import SceneModel

/// Checks that the photos are aligned by what they are aimed at.
///
/// Where an object moves in front of surroundings with more texture, photos may be aligned by
/// these: their features are then observations of points, but hardly any of those around the point
/// that the optical axes meet at. So it is with an object that stands still, but has too little
/// texture for features; then patches of a dense cloud agree across photos in both.
struct FocusCheck: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Radius of the focus, as a share of a photo's longer side, and the factor by which that of
    /// its surroundings is larger. Chosen.
    var radius = 0.12
    var surroundingsFactor = 2.5
    /// Minimum number of observations that the focus of all photos should have, as its
    /// surroundings do; fewer are not informative. Chosen.
    var minimumExpected = 50.0
    /// Minimum share of the features in the focus that are observations of points, relative to that
    /// of the surroundings. Measured: 0.03 and 0.09 for objects that were aligned by the table,
    /// 0.70 or more in 21 other sets (docs/experiments/2026-11-masks.md, Blur, concerns and sky).
    var minimumRatio = 0.25
    /// The same for the cells of a dense cloud. Measured: 0.16 and 0.25 for a vase and a statue
    /// that were turned by hand and aligned by the table (captures of seed 61), 0.98 for a vase
    /// that stands still and has hardly any features (docs/experiments/2026-11-planes.md).
    var minimumDenseRatio = 0.5
    /// Number of cells along the radius of the focus in which points of a dense cloud are searched
    /// for. Chosen: about five pixels of the coarse cloud.
    var cellsPerRadius = 6
    /// Minimum angle between the directions from which the focus is seen, in degrees, as twice the
    /// deviation from their mean that nine of ten photos are within. From less, there is no model
    /// of an object: it was turned in front of a camera that stood still, or is seen from one side
    /// only. Chosen: it is 60 to 285 in the ten real sets in which nothing moves
    /// (docs/experiments/2026-11-moving-objects.md).
    var minimumSpreadDegrees = 8.0
  }

  /// The shares of features that are observations of points, in all photos together.
  struct Findings: Equatable, Sendable {
    /// The number of features in the focus.
    var features = 0.0
    var focusShare = 0.0
    var surroundingsShare = 0.0
    /// Twice the angle to the mean direction of the focus that nine of ten photos are within, in
    /// degrees. Limit: no angle is larger.
    var spreadDegrees = 180.0

    /// The number of features in the focus that are observations of points.
    var observations: Double { features * focusShare }
    /// The number of features in the focus that would be observations if it were like its
    /// surroundings.
    var expected: Double { features * surroundingsShare }
  }

  var options = Options()

  /// Records the findings, and a concern if the photos are aligned by the surroundings.
  /// `denseCloud` is asked for only if the features are a sign that they are.
  func run(
    _ reconstruction: Reconstruction, _ features: [FeatureSet], _ notes: StageNotes,
    denseCloud: () throws -> PointCloud?
  ) rethrows {
    guard let findings = findings(reconstruction, features) else { return }
    notes.record("focusFeatures", findings.features)
    notes.record("focusShare", findings.focusShare)
    notes.record("surroundingsShare", findings.surroundingsShare)
    notes.record("viewSpreadDegrees", findings.spreadDegrees)
    var isAlignedByFocus =
      findings.expected < options.minimumExpected
      || findings.focusShare >= options.minimumRatio * findings.surroundingsShare
    if !isAlignedByFocus, let cloud = try denseCloud(),
      let dense = denseShares(of: cloud, reconstruction)
    {
      notes.record("denseFocusShare", dense.focus)
      notes.record("denseSurroundingsShare", dense.surroundings)
      isAlignedByFocus = dense.focus >= options.minimumDenseRatio * dense.surroundings
    }
    if !isAlignedByFocus {
      notes.flagAsSuspect(
        "The photos were aligned by the surroundings of what they are aimed at, which hardly "
          + "matches between photos: it moves, is shiny or transparent. Cover what is around it "
          + "with a plain cloth, or give masks.")
    } else if findings.spreadDegrees < options.minimumSpreadDegrees {
      notes.flagAsSuspect(
        "All photos seem to show what they are aimed at from one direction, within "
          + "\(Int(findings.spreadDegrees.rounded(.up)))°. If it was turned between photos, they "
          + "were aligned by its surroundings, and it isn't in the model: cover what is around it "
          + "with a plain cloth, or give masks. If it wasn't, walk around it.")
    }
  }

  /// Whether another map of the same features has at least a share of the observations of what the
  /// photos are aimed at.
  func isKept(
    from first: Reconstruction, in other: Reconstruction, _ features: [FeatureSet],
    minimumShare: Double
  ) -> Bool {
    guard let before = findings(first, features)?.observations else { return true }
    return findings(other, features)?.observations ?? 0 >= minimumShare * before
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
    var (inner, outer) = (Tally(), Tally())
    for view in views(of: focus, reconstruction) {
      for (position, isUsed) in zip(features[view.photo].positions, isObservation[view.photo]) {
        let distance = (SIMD2<Double>(position) - view.center).length / view.radius
        if distance < 1 {
          inner.add(isUsed)
        } else if distance < options.surroundingsFactor {
          outer.add(isUsed)
        }
      }
    }
    return Findings(
      features: Double(inner.count), focusShare: inner.share, surroundingsShare: outer.share,
      spreadDegrees: spreadDegrees(of: focus))
  }

  /// The shares of the cells of the focus and of its surroundings, in all photos together, in which
  /// a photo agrees with others on a point of a dense cloud; nil if the optical axes don't
  /// determine a focus.
  func denseShares(
    of cloud: PointCloud, _ reconstruction: Reconstruction
  ) -> (focus: Double, surroundings: Double)? {
    let depths = reconstruction.medianDepths(of: cloud)
    guard let focus = ViewFocus(reconstruction, depths: depths) else { return nil }
    var pointsOfPhoto = reconstruction.photos.map { _ in [Int]() }
    for point in cloud.positions.indices {
      for photo in cloud.visiblePhotos(of: point) where Int(photo) < pointsOfPhoto.count {
        pointsOfPhoto[Int(photo)].append(point)
      }
    }
    var (inner, outer) = (Tally(), Tally())
    for view in views(of: focus, reconstruction) {
      var cells = FocusCells(
        center: view.center, radius: view.radius, factor: options.surroundingsFactor,
        cellsPerRadius: options.cellsPerRadius)
      for point in pointsOfPhoto[view.photo] {
        let position = view.pose * SIMD3<Double>(cloud.positions[point])
        if position.z > 0 { cells.mark(view.camera.project(position)) }
      }
      cells.forEach(in: view.camera) { distance, isMarked in
        if distance < 1 { inner.add(isMarked) } else { outer.add(isMarked) }
      }
    }
    return (inner.share, outer.share)
  }

  /// A photo, with the focus in front of its camera.
  private struct View {
    var photo: Int
    /// `cameraFromWorld`.
    var pose: RigidTransform
    var camera: Camera
    /// The projection of the focus, and its radius, in pixels.
    var center: SIMD2<Double>
    var radius: Double
  }

  private func views(of focus: ViewFocus, _ reconstruction: Reconstruction) -> [View] {
    reconstruction.registered.compactMap { photo in
      guard let pose = reconstruction.poses[photo.index], (pose * focus.point).z > 0 else {
        return nil
      }
      let camera = reconstruction.camera(of: photo)
      return View(
        photo: photo.index, pose: pose, camera: camera, center: camera.project(pose * focus.point),
        radius: options.radius * Double(max(camera.width, camera.height)))
    }
  }

  /// Features, and how many of them are observations.
  private struct Tally {
    var count = 0
    var used = 0

    var share: Double { count == 0 ? 0 : Double(used) / Double(count) }

    mutating func add(_ isUsed: Bool) {
      count += 1
      if isUsed { used += 1 }
    }
  }

  private func spreadDegrees(of focus: ViewFocus) -> Double {
    let directions = focus.centers.map { ($0 - focus.point).normalized }
    let mean = directions.reduce(SIMD3<Double>.zero, +)
    // Directions all around cancel out.
    guard mean.length > 0.1 * Double(directions.count) else { return 180 }
    let axis = mean.normalized
    let angles = directions.map { acos(min(1, max(-1, $0.dot(axis)))) * 180 / .pi }.sorted()
    return 2 * angles[min(angles.count - 1, angles.count * 9 / 10)]
  }
}
