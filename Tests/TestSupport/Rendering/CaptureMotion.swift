import Foundation
import SceneModel

/// A kind of capture: how camera and object move from photo to photo.
package enum Capture: String, CaseIterable, Sendable {
  /// The camera moves around the object on two rings.
  case walk
  /// The camera rests at each of two elevations, and a plate turns the object.
  case turntable
  /// As with a turntable, but a hand turns the object on the table, by irregular steps, and another
  /// holds the camera.
  case hand
  /// The camera moves around the object, which then is laid on another side.
  case flip
}

/// The poses of camera and object in each photo of a capture.
///
/// Room: right-handed, +y up, meters; the table is at y = 0.
struct CaptureMotion {
  let mesh: Mesh
  let photoCount: Int
  /// The elevations of the camera in degrees; the photos are divided evenly between them.
  var elevations = [22.0, 48.0]
  /// The free space around the object in the photos, in meters at its distance.
  var margin = 0.035
  /// The farthest that a hand moves the camera away from its place, in meters.
  var sway = 0.03
  /// Whether the irregularities of a hand's steps don't add up, so that a full turn is complete.
  var completesTurn = false
  private var random: SeededGenerator

  init(of mesh: Mesh, photoCount: Int, seed: UInt64) {
    self.mesh = mesh
    self.photoCount = photoCount
    random = SeededGenerator(seed: seed)
  }

  mutating func views(_ capture: Capture, of object: CaptureObject) -> [CaptureScene.View] {
    switch capture {
    case .walk: walk()
    case .turntable: turntable()
    case .hand: hand()
    case .flip: flip(object.turnedOver)
    }
  }

  mutating func walk() -> [CaptureScene.View] {
    let roomFromObject = rest(.identity, turned: angle(180), at: .zero)
    let target = roomFromObject * middle
    let count = photoCount / elevations.count
    return (0..<photoCount).map { index in
      let ring = min(elevations.count - 1, index / max(1, count))
      return CaptureScene.View(
        cameraFromRoom: walker(
          Double(index % count) + 0.5 * Double(ring), of: count, elevations[ring], target),
        roomFromObject: roomFromObject)
    }
  }

  private mutating func flip(_ turnedOver: Quaternion) -> [CaptureScene.View] {
    let count = photoCount / 2
    let other = place(0.03, around: SIMD2(0.03, -0.04))
    let rests = [
      rest(.identity, turned: angle(180), at: .zero),
      rest(turnedOver, turned: angle(180), at: other),
    ]
    return (0..<photoCount).map { index in
      let roomFromObject = rests[min(1, index / max(1, count))]
      let camera = walker(
        Double(index % count), of: count, elevations[index % 2], roomFromObject * middle)
      return CaptureScene.View(cameraFromRoom: camera, roomFromObject: roomFromObject)
    }
  }

  private mutating func turntable() -> [CaptureScene.View] {
    let count = photoCount / 2
    let place = place(0.01)
    let start = rest(.identity, turned: angle(180), at: place, on: CapturePlate.height)
    let target = start * middle
    let cameras = elevations.map { degrees in
      camera(turn: 0.02 * random.uniform(), degrees, target + jitter(0.01), jitter(0.015))
    }
    return (0..<photoCount).map { index in
      let ring = min(1, index / max(1, count))
      let steps = Double(index % count) + 0.5 * Double(ring)
      let turn = 2 * .pi * steps / Double(count) + angle(1.5)
      let roomFromPlate = RigidTransform(
        rotation: Quaternion(angle: turn, axis: [0, 1, 0]), translation: .zero)
      return CaptureScene.View(
        cameraFromRoom: cameras[ring], roomFromObject: roomFromPlate * start,
        roomFromPlate: roomFromPlate)
    }
  }

  mutating func hand() -> [CaptureScene.View] {
    let count = photoCount / elevations.count
    var (turn, place, offset) = (angle(180), SIMD2<Double>.zero, SIMD3<Double>.zero)
    let start = rest(.identity, turned: turn, at: place) * middle
    var excess = 0.0
    return (0..<photoCount).map { index in
      let irregularity = angle(completesTurn ? 4 : 8)
      turn += 2 * .pi / Double(count) + irregularity - excess
      if completesTurn { excess = irregularity }
      let shift = self.place(0.015)
      place = shortened(place + shift, to: 0.025)
      let step = jitter(1)
      offset += step * ((0.01 + 0.02 * random.uniform()) / max(step.length, 1e-9))
      offset *= min(1, sway / max(offset.length, 1e-9))
      let ring = min(elevations.count - 1, index / max(1, count))
      return CaptureScene.View(
        cameraFromRoom: camera(turn: 0, elevations[ring], start + jitter(0.012), offset),
        roomFromObject: rest(.identity, turned: turn, at: place))
    }
  }

  /// The frames of a video of an object at rest: the camera moves on an arc of `degrees` in front
  /// of it, and slowly sways.
  mutating func arc(degrees: Double) -> [CaptureScene.View] {
    let roomFromObject = rest(.identity, turned: angle(180), at: .zero)
    let target = roomFromObject * middle
    let phases = (0..<4).map { _ in 2 * .pi * random.uniform() }
    return (0..<photoCount).map { index in
      let step = 0.3 * (random.uniform() - 0.5)
      let t = (Double(index) + step) / Double(max(1, photoCount - 1))
      let waves = zip(phases, [2.3, 3.1, 1.7, 1.2]).map { sin(2 * .pi * $1 * t + $0) }
      let offset = SIMD3(waves[0], waves[1], waves[2]) * 0.01
      return CaptureScene.View(
        cameraFromRoom: camera(
          turn: (t - 0.5) * degrees / 360, elevations[0] + 3 * waves[3], target + jitter(0.006),
          offset), roomFromObject: roomFromObject)
    }
  }

  // MARK: Poses

  /// The middle of the object's bounding box, in its frame.
  private var middle: SIMD3<Double> {
    let (low, high) = mesh.captureBounds
    return (low + high) / 2
  }

  /// The distance at which the object and the margin around it fit into the photos.
  private var distance: Double {
    let (low, high) = mesh.captureBounds
    return 3 * ((high - low).length / 2 + margin)
  }

  /// The `cameraFromRoom` of a photographer who walks around `target`: photo `number` of `count`.
  private mutating func walker(
    _ number: Double, of count: Int, _ degrees: Double, _ target: SIMD3<Double>
  ) -> RigidTransform {
    let turn = (number + 0.3 * (random.uniform() - 0.5)) / Double(count)
    let elevation = degrees + 4 * (random.uniform() - 0.5)
    return camera(turn: turn, elevation, target + jitter(0.012), jitter(0.02))
  }

  /// The `cameraFromRoom` of a camera that faces `target`, `offset` away from its place on a ring,
  /// rolled by up to a degree.
  private mutating func camera(
    turn: Double, _ degrees: Double, _ target: SIMD3<Double>, _ offset: SIMD3<Double>
  ) -> RigidTransform {
    let (azimuth, elevation) = (2 * .pi * turn, degrees * .pi / 180)
    let direction = SIMD3(
      cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
    let roll = RigidTransform(
      rotation: Quaternion(angle: angle(1), axis: [0, 0, 1]), translation: .zero)
    return roll * RigidTransform.lookingAt(target, from: target + direction * distance + offset)
  }

  /// The `roomFromObject` of the object lying on a side, turned about the vertical axis, with the
  /// middle of its bounding box above `place` (x and z) and its lowest vertex at `height`.
  private func rest(
    _ side: Quaternion, turned angle: Double, at place: SIMD2<Double>, on height: Double = 0
  ) -> RigidTransform {
    let rotation = Quaternion(angle: angle, axis: [0, 1, 0]) * side
    let lowest = mesh.positions.map { (rotation * SIMD3<Double>($0)).y }.min() ?? 0
    let center = rotation * middle
    return RigidTransform(
      rotation: rotation,
      translation: SIMD3(place.x - center.x, height - lowest, place.y - center.z))
  }

  // MARK: Random variations

  /// Radians, between −`degrees` and `degrees`.
  private mutating func angle(_ degrees: Double) -> Double {
    (2 * random.uniform() - 1) * degrees * .pi / 180
  }

  /// A vector of at most `length`.
  private mutating func jitter(_ length: Double) -> SIMD3<Double> {
    let direction = random.normal3().normalized
    return direction * (length * cbrt(random.uniform()))
  }

  /// A place within `radius` of `center`.
  private mutating func place(
    _ radius: Double, around center: SIMD2<Double> = .zero
  ) -> SIMD2<Double> {
    let (angle, distance) = (2 * .pi * random.uniform(), radius * random.uniform().squareRoot())
    return center + SIMD2(cos(angle), sin(angle)) * distance
  }

  private func shortened(_ vector: SIMD2<Double>, to length: Double) -> SIMD2<Double> {
    vector * min(1, length / max(1e-9, vector.squaredLength.squareRoot()))
  }
}
