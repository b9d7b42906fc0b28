import Foundation
import SceneModel

/// The up direction from the accelerometers of the cameras: the mean over the photos that agree.
struct GravityUp: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Photos agree within this angle. Chosen.
    var toleranceDegrees = 10.0
    /// Minimum fraction of the photos that must agree. Chosen.
    var minimumShare = 0.5
    /// Maximum roll of the camera: people hold cameras roughly upright, so gravity deviates from
    /// the downward image axis by at most this. Chosen.
    var maximumRollDegrees = 60.0
    /// Minimum sine of the angle between gravity and the optical axis at which the roll is
    /// meaningful. Chosen.
    var minimumSine = 0.3
  }

  var options = Options()

  /// Returns a unit vector in the frame of the reconstruction; `readings` are keyed by sample ID.
  /// Nil if there is no gravity reading, or the readings contradict each other or the photos.
  func run(
    _ readings: [Int: SensorReading], _ reconstruction: Reconstruction, _ notes: StageNotes
  ) -> SIMD3<Double>? {
    let known = reconstruction.registered.compactMap {
      id -> (down: SIMD3<Double>, up: SIMD3<Double>)? in
      guard let down = readings[reconstruction.photos[id.index].sampleID]?.gravity?.normalized,
        down.squaredLength > 0.5, let pose = reconstruction.poses[id.index]
      else { return nil }
      return (down, -(pose.rotation.conjugate * down))
    }
    guard !known.isEmpty else { return nil }
    let upright = known.filter { isUpright($0.down) }.map(\.up)
    let agreeing =
      upright.map { up in upright.filter { agree($0, up) } }
      .max { $0.count < $1.count } ?? []
    notes.record("gravityPhotos", Double(known.count))
    notes.record("gravityPhotosUsed", Double(agreeing.count))
    guard Double(agreeing.count) >= options.minimumShare * Double(known.count) else {
      notes.warn(
        "The samples' gravity is not used: only \(agreeing.count) of \(known.count) agree with "
          + "each other and with the photos. Gravity must be in the frame of a phone: x right, "
          + "y up, z toward the user.")
      return nil
    }
    return agreeing.reduce(.zero, +).normalized
  }

  private func agree(_ a: SIMD3<Double>, _ b: SIMD3<Double>) -> Bool {
    a.dot(b) > cos(options.toleranceDegrees * .pi / 180)
  }

  /// Whether gravity points down in the photo, or is nearly parallel to the optical axis.
  private func isUpright(_ down: SIMD3<Double>) -> Bool {
    let (across, along) = (down.x, down.y)
    guard hypot(across, along) > options.minimumSine else { return true }
    return abs(atan2(across, along)) < options.maximumRollDegrees * .pi / 180
  }
}
