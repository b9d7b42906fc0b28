import Foundation
import SceneModel

/// Directions around an object: azimuth about the vertical and elevation above the horizon.
struct Compass {
  /// Unit vectors: up, and two horizontal ones.
  private let up: SIMD3<Double>
  private let east: SIMD3<Double>
  private let north: SIMD3<Double>
  let center: SIMD3<Double>

  init(center: SIMD3<Double>, up: SIMD3<Double>) {
    let up = up.squaredLength > 0 ? up.normalized : [0, 1, 0]
    let other: SIMD3<Double> = abs(up.x) < 0.9 ? [1, 0, 0] : [0, 0, 1]
    self.center = center
    self.up = up
    east = (other - up * up.dot(other)).normalized
    north = up.cross(east)
  }

  /// A direction from the center; angles in degrees.
  struct Bearing: Hashable, Sendable {
    /// 0 ..< 360.
    var azimuth: Double
    /// −90 … 90.
    var elevation: Double

    /// The azimuths' difference, 0 … 180.
    func turn(to other: Bearing) -> Double {
      let difference = abs(azimuth - other.azimuth).truncatingRemainder(dividingBy: 360)
      return min(difference, 360 - difference)
    }
  }

  func bearing(of point: SIMD3<Double>) -> Bearing {
    let direction = (point - center).normalized
    let azimuth = atan2(direction.dot(north), direction.dot(east)) * 180 / .pi
    let elevation = asin(min(1, max(-1, direction.dot(up)))) * 180 / .pi
    return Bearing(azimuth: azimuth < 0 ? azimuth + 360 : azimuth, elevation: elevation)
  }

  /// The point at a distance from the center.
  func point(at bearing: Bearing, distance: Double) -> SIMD3<Double> {
    let (a, e) = (bearing.azimuth * .pi / 180, bearing.elevation * .pi / 180)
    return center + distance * (cos(e) * (cos(a) * east + sin(a) * north) + sin(e) * up)
  }
}
