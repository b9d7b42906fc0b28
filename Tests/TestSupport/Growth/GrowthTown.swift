import Foundation
import SceneModel

/// A square town: streets `spacing` meters apart in both directions, with blocks of houses between
/// and around them. The ground is y = 0.
struct GrowthTown: Sendable {
  struct Facade {
    /// The lower corner; the facade extends from it in the direction `along`.
    var corner, along, normal: SIMD3<Double>
    var width: Double
  }

  static let height = 9.0
  private static let spacing = 40.0
  /// Half the width of a street in meters.
  private static let verge = 6.0
  /// Angle in radians between the street and the optical axes: the axes in crossing streets nearly
  /// agree.
  private static let yaw = 0.75
  /// Approximate distance between photos in meters.
  private static let step = 2.0

  /// Number of blocks between the streets in each direction.
  private let size: Int

  /// A town whose streets are as long as a drive of `photoCount` photos.
  init(photoCount: Int) {
    let targetLength = Double(photoCount) * Self.step
    let sizes = 1...100
    size =
      sizes.min { abs(Self.length($0) - targetLength) < abs(Self.length($1) - targetLength) } ?? 1
  }

  private static func length(_ size: Int) -> Double { Double(2 * (size + 1) * size) * spacing }

  var facades: [Facade] {
    var facades: [Facade] = []
    let width = Self.spacing - 2 * Self.verge
    for i in -1...size {
      for j in -1...size {
        let low = SIMD3(
          Double(i) * Self.spacing + Self.verge, 0, Double(j) * Self.spacing + Self.verge)
        let (x, z) = (SIMD3(1.0, 0, 0), SIMD3(0, 0, 1.0))
        facades += [
          Facade(corner: low, along: x, normal: -z, width: width),
          Facade(corner: low + z * width, along: x, normal: z, width: width),
          Facade(corner: low, along: z, normal: -x, width: width),
          Facade(corner: low + x * width, along: z, normal: x, width: width),
        ]
      }
    }
    return facades
  }

  /// The cameras: along all streets in one direction, alternating back and forth, then along the
  /// others.
  func drive(photoCount: Int, _ random: inout SeededGenerator) -> [RigidTransform] {
    let streetLength = Double(size) * Self.spacing
    let step = Self.length(size) / Double(max(1, photoCount))
    return (0..<photoCount).map { index in
      let traveled = (Double(index) + 0.5) * step
      let street = min(2 * size + 1, Int(traveled / streetLength))
      let (number, isCrossing) = (street % (size + 1), street > size)
      let isReturning = number % 2 == 1
      let along = traveled - Double(street) * streetLength
      let place = isReturning ? streetLength - along : along
      let side = Double(number) * Self.spacing + random.uniform() - 0.5
      let eye = isCrossing ? SIMD3(side, 1.7, place) : SIMD3(place, 1.7, side)
      let heading = (isCrossing ? Double.pi / 2 : 0) + (isReturning ? .pi : 0)
      let yaw = heading + (index % 2 == 0 ? Self.yaw : -Self.yaw) + 0.05 * random.normal()
      let pitch = 0.12 + 0.02 * random.normal()
      return RigidTransform.lookingAt(
        eye + [cos(yaw) * cos(pitch), sin(pitch), sin(yaw) * cos(pitch)], from: eye)
    }
  }

  /// Whether a block occludes a point; both positions are below the roofs.
  func isHidden(_ point: SIMD3<Double>, from eye: SIMD3<Double>) -> Bool {
    func block(_ coordinate: Double) -> Int { Int((coordinate / Self.spacing).rounded(.down)) }
    let (i, j) = (block(eye.x), block(eye.z))
    let (m, n) = (block(point.x), block(point.z))
    for x in min(i, m)...max(i, m) {
      for z in min(j, n)...max(j, n) where crosses(x, z, eye, point) { return true }
    }
    return false
  }

  /// Whether the line of sight enters a block deeper than the relief of its facades.
  private func crosses(_ i: Int, _ j: Int, _ eye: SIMD3<Double>, _ point: SIMD3<Double>) -> Bool {
    let inset = Self.verge + 0.35
    var (enter, leave) = (0.0, 1.0)
    for (from, to, cell) in [(eye.x, point.x, i), (eye.z, point.z, j)] {
      let low = Double(cell) * Self.spacing + inset
      let high = Double(cell + 1) * Self.spacing - inset
      let direction = to - from
      guard abs(direction) > 1e-9 else {
        if from <= low || from >= high { return false }
        continue
      }
      let (a, b) = ((low - from) / direction, (high - from) / direction)
      enter = max(enter, min(a, b))
      leave = min(leave, max(a, b))
    }
    return enter < leave
  }
}
