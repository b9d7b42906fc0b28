import Foundation
import Kernels
import SceneModel

/// The photo whose view of a track's point is the template for the other photos.
struct TrackReference: Sendable {
  var photo: Int
  /// The point's keypoint in it, in pixels of the full-size photo.
  var pixel: SIMD2<Double>
  /// Distance between template samples in pixels of the full-size photo.
  var step: Double
  /// The point and the surface normal in the world frame; the normal is the mean of the viewing
  /// directions.
  var point: SIMD3<Double>
  var normal: SIMD3<Double>

  /// The projection of the template center into another photo, and the Jacobian by rows of its
  /// pixel with respect to the reference pixel, on the plane through the point; nil if either photo
  /// is behind that plane.
  func warp(to photo: Int, in photos: PosedPhotos) -> (pixel: SIMD2<Double>, warp: SIMD4<Double>)? {
    guard let from = photos.poses[self.photo], let into = photos.poses[photo] else { return nil }
    let camera = photos.cameras[Int(photos.cameraOfPhoto[self.photo])]
    let target = photos.cameras[Int(photos.cameraOfPhoto[photo])]
    let center = from.center
    func project(_ pixel: SIMD2<Double>) -> SIMD2<Double>? {
      let ray = camera.unproject(pixel)
      let direction = from.rotation.conjugate * SIMD3(ray.x, ray.y, 1)
      let slope = normal.dot(direction)
      guard slope < -1e-6 else { return nil }
      let seen = into * (center + normal.dot(point - center) / slope * direction)
      return seen.z > 1e-9 ? target.project(seen) : nil
    }
    // The Jacobian is estimated by central differences over this number of pixels. Chosen.
    let reach = 2.0
    guard into.center.dot(normal) > point.dot(normal), let middle = project(pixel),
      let right = project(pixel + [reach, 0]), let left = project(pixel - [reach, 0]),
      let below = project(pixel + [0, reach]), let above = project(pixel - [0, reach])
    else { return nil }
    let (byX, byY) = ((right - left) / (2 * reach), (below - above) / (2 * reach))
    return (middle, [byX.x, byY.x, byX.y, byY.y])
  }
}

extension TrackReference {
  /// Selects the observation with the most central viewing direction as reference.
  init?(track: Int, of map: SparseMap, scale: (_ photo: Int, _ feature: Int32) -> Double) {
    let active = map.activeObservations(of: track)
    let directions = active.compactMap { index in
      map.photos.poses[Int(map.tracks.photos[index])]
        .map { ($0.center - map.positions[track]).normalized }
    }
    let mean = directions.reduce(.zero, +)
    guard active.count >= 2, directions.count == active.count, mean.length > 1e-9 else {
      return nil
    }
    var best = 0
    for k in directions.indices where directions[k].dot(mean) > directions[best].dot(mean) {
      best = k
    }
    let index = active[best]
    let photo = Int(map.tracks.photos[index])
    self.init(
      photo: photo, pixel: map.tracks.pixels[index],
      step: scale(photo, map.tracks.features[index]), point: map.positions[track],
      normal: mean.normalized)
  }
}
