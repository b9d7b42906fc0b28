import Foundation
import SceneModel

/// Up as the accelerometers of the cameras tell it: the mean of the photos that agree.
struct GravityUp: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Photos agree within this angle.
    var toleranceDegrees = 10.0
    /// Share of the photos that have to agree.
    var minimumShare = 0.5
    /// People hold cameras upright: gravity may differ so much from the way down in the photo.
    var maximumRollDegrees = 60.0
  }

  var options = Options()

  /// `readings` are by sample id. Nil where none has gravity, or where they contradict each other or
  /// the photos.
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
    notes.count("gravityPhotos", Double(known.count))
    notes.count("gravityPhotosUsed", Double(agreeing.count))
    guard Double(agreeing.count) >= options.minimumShare * Double(known.count) else {
      notes.warn(
        "The samples' gravity is not used: only \(agreeing.count) of \(known.count) agree with each "
          + "other and with the photos. It is meant in the frame of a phone: x right, y up, z towards "
          + "its user.")
      return nil
    }
    return agreeing.reduce(.zero, +).normalized
  }

  private func agree(_ a: SIMD3<Double>, _ b: SIMD3<Double>) -> Bool {
    a.dot(b) > cos(options.toleranceDegrees * .pi / 180)
  }

  /// Whether gravity points down in the photo, or mostly along the line of sight.
  private func isUpright(_ down: SIMD3<Double>) -> Bool {
    let (across, along) = (down.x, down.y)
    guard hypot(across, along) > 0.3 else { return true }
    return abs(atan2(across, along)) < options.maximumRollDegrees * .pi / 180
  }
}
