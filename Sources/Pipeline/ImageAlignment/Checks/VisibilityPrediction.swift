import Foundation
import Kernels
import SceneModel

/// Predicts which points a photo should show, from its pose and the points it observes.
struct VisibilityPrediction {
  let photo: Int
  let pose: RigidTransform
  private let depths: DepthGrid
  /// Tracks observed by features of the photo, and their pixels.
  private let known: [Int32: SIMD2<Double>]

  /// `seen` lists the tracks observed by features of the photo.
  init(
    _ photo: Int, at pose: RigidTransform, seen: [(track: Int32, pixel: SIMD2<Double>)],
    _ map: SparseMap, _ options: SceneAmbiguityCheck.Options
  ) {
    (self.photo, self.pose) = (photo, pose)
    depths = DepthGrid(
      map.photos.cameras[Int(map.photos.cameraOfPhoto[photo])],
      seen.map { ($0.pixel, (pose * map.positions[Int($0.track)]).z) }, cells: options.cells)
    known = Dictionary(seen.map { ($0.track, $0.pixel) }) { first, _ in first }
  }

  /// Median depth of all points that the photo observes; nil without any.
  var medianDepth: Double? { depths.medianDepth }

  /// The points of another photo that this photo should show.
  func hypothesis(
    about other: Int, _ map: SparseMap, _ options: SceneAmbiguityCheck.Options,
    reference: (_ observation: Int) -> TrackReference
  ) -> VisibilityHypothesis {
    var hypothesis = VisibilityHypothesis(other: other, photo: photo)
    guard let otherCenter = map.photos.poses[other]?.center else { return hypothesis }
    var photos = map.photos
    photos.poses[photo] = pose
    for index in map.tracks.observationsOfPhoto[other].map(Int.init) where map.isActive[index] {
      let track = map.tracks.trackOfObservation[index]
      if let pixel = known[track] {
        hypothesis.confirmedPixels.append(pixel)
      } else if let point = expected(track, reference(index), from: otherCenter, photos, options) {
        hypothesis.points.append(point)
      }
    }
    let stride = max(
      1, (hypothesis.points.count + options.maximumPoints - 1) / options.maximumPoints)
    hypothesis.points = Swift.stride(from: 0, to: hypothesis.points.count, by: stride).map {
      hypothesis.points[$0]
    }
    return hypothesis
  }

  /// The expected position of a point that another photo observes from `otherCenter`; nil if it may
  /// be occluded, lies outside, or is viewed too differently.
  private func expected(
    _ track: Int32, _ reference: TrackReference, from otherCenter: SIMD3<Double>,
    _ photos: PosedPhotos, _ options: SceneAmbiguityCheck.Options
  ) -> ExpectedPoint? {
    let camera = photos.cameras[Int(photos.cameraOfPhoto[photo])]
    let (toCamera, toOther) = (pose.center - reference.point, otherCenter - reference.point)
    let ratio = toCamera.length / toOther.length
    let depth = (pose * reference.point).z
    let (maximumAngle, maximumRatio) = (
      options.maximumAngleDegrees * .pi / 180, options.maximumDistanceRatio
    )
    guard depth > 0, ratio < maximumRatio, 1 / ratio < maximumRatio,
      toCamera.dot(toOther) > cos(maximumAngle) * toCamera.length * toOther.length,
      let (pixel, warp) = reference.warp(to: photo, in: photos)
    else { return nil }
    // The whole template, including the search range, must lie within the photo.
    let margin = options.templateReach * reference.step
    guard pixel.x > margin, pixel.y > margin, pixel.x < Double(camera.width) - margin,
      pixel.y < Double(camera.height) - margin,
      let nearestDepth = depths.nearestDepth(at: pixel),
      depth < options.depthTolerance * nearestDepth
    else { return nil }
    return ExpectedPoint(track: track, reference: reference, pixel: pixel, warp: warp)
  }
}
