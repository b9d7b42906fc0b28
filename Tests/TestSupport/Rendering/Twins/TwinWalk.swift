import Foundation
import SceneModel

/// The poses of a hand-held camera on a walk around an object: irregular steps, and a distance,
/// height, direction and roll that drift. All values were chosen.
struct TwinWalk {
  /// What the photos should show in the middle.
  let target: SIMD3<Double>
  /// The mean distance from it.
  let distance: Double
  private var random: TwinRandom

  init(around target: SIMD3<Double>, at distance: Double, seed: UInt64) {
    self.target = target
    self.distance = distance
    random = TwinRandom(seed: seed)
  }

  /// Several rings, each with a start and a sense of its own, in which neighboring photos follow
  /// each other.
  mutating func rings(_ count: Int, degrees: [Double]) -> [RigidTransform] {
    degrees.indices.flatMap { ring in
      let photos = (ring + 1) * count / degrees.count - ring * count / degrees.count
      let turns = random.chance(0.5) ? 1.02 : -1.02
      return path(photos, turns: turns) { _ in degrees[ring] }
    }
  }

  /// One continuous walk with several turns, from the lower elevation to the upper one.
  mutating func spiral(_ count: Int, turns: Double, degrees: (Double, Double))
    -> [RigidTransform]
  {
    path(count, turns: random.chance(0.5) ? turns : -turns) {
      degrees.0 + (degrees.1 - degrees.0) * $0
    }
  }

  private mutating func path(
    _ count: Int, turns: Double, degrees: (Double) -> Double
  ) -> [RigidTransform] {
    let start = random.double(0, 1)
    let drifts = (0..<6).map { _ in Drift(&random) }
    return (0..<count).map { index in
      let step = Double(index) + random.within(0.3)
      let t = step / Double(max(1, count))
      let elevation = degrees(t) + 3.5 * drifts[0].value(t) + random.within(1.2)
      let reach = distance * (1 + 0.1 * drifts[1].value(t) + random.within(0.03))
      let shift =
        SIMD3(drifts[2].value(t), drifts[3].value(t), drifts[4].value(t))
        + SIMD3(random.within(0.5), random.within(0.5), random.within(0.5))
      let roll = (3 * drifts[5].value(t) + random.within(1)) * .pi / 180
      return camera(
        turn: start + turns * t, max(2, elevation), reach, target + shift * (0.02 * distance), roll)
    }
  }

  private func camera(
    turn: Double, _ degrees: Double, _ reach: Double, _ aim: SIMD3<Double>, _ roll: Double
  ) -> RigidTransform {
    let (azimuth, elevation) = (2 * .pi * turn, degrees * .pi / 180)
    let direction = SIMD3(
      cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
    let tilted = RigidTransform(
      rotation: Quaternion(angle: roll, axis: [0, 0, 1]), translation: .zero)
    return tilted * RigidTransform.lookingAt(aim, from: target + direction * reach)
  }

  /// A slow change between −1 and 1 along the walk.
  private struct Drift {
    private let rates: [Double]
    private let phases: [Double]

    init(_ random: inout TwinRandom) {
      rates = [random.double(0.8, 1.6), random.double(2, 3.5)]
      phases = [random.double(0, 2 * Double.pi), random.double(0, 2 * Double.pi)]
    }

    func value(_ t: Double) -> Double {
      0.6 * sin(2 * .pi * rates[0] * t + phases[0]) + 0.4 * sin(2 * .pi * rates[1] * t + phases[1])
    }
  }
}
