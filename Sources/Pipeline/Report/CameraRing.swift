import Foundation
import SceneModel

/// The registered photos by their bearings from the object.
struct CameraRing {
  private struct Camera {
    var name: String
    var bearing: Compass.Bearing
    var distance: Double
  }

  private let cameras: [Camera]

  init(_ reconstruction: Reconstruction, _ compass: Compass) {
    cameras = reconstruction.registered.compactMap { photo in
      guard let pose = reconstruction.poses[photo.index] else { return nil }
      return Camera(
        name: reconstruction.photos[photo.index].name, bearing: compass.bearing(of: pose.center),
        distance: (pose.center - compass.center).length)
    }
  }

  /// The median distance from the object; nil without photos.
  var distance: Double? {
    cameras.map(\.distance).upperMedian.flatMap { $0 > 0 && $0.isFinite ? $0 : nil }
  }

  /// In degrees; nil without photos.
  var lowestElevation: Double? { cameras.map(\.bearing.elevation).min() }

  /// Two photos side by side, seen from above.
  struct Gap: Hashable {
    var from: String
    var to: String
    /// In degrees.
    var width: Double
    /// The mean of the two elevations, in degrees.
    var elevation: Double
  }

  /// Bands of elevation, in degrees, within which photos are side by side: a round of photos is
  /// seldom wider. Chosen.
  private static let band = 35.0

  /// The photos on both sides of a bearing, of those at a similar height if there are three. Nil if
  /// there are no two.
  func gap(around bearing: Compass.Bearing) -> Gap? {
    let similar = cameras.filter { abs($0.bearing.elevation - bearing.elevation) < Self.band }
    let ring = similar.count >= 3 ? similar : cameras
    func turn(_ camera: Camera) -> Double {
      let turn = camera.bearing.azimuth - bearing.azimuth
      return turn < 0 ? turn + 360 : turn
    }
    guard let next = ring.min(by: { (turn($0), $0.name) < (turn($1), $1.name) }),
      let last = ring.max(by: { (turn($0), $0.name) < (turn($1), $1.name) }), next.name != last.name
    else { return nil }
    return Gap(
      from: last.name, to: next.name, width: 360 - turn(last) + turn(next),
      elevation: (last.bearing.elevation + next.bearing.elevation) / 2)
  }
}
