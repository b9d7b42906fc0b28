import Foundation
import Kernels
import SceneModel

/// The viewing directions, in world orientation, of some tracks in the photos of known rotation.
private struct TrackDirections {
  /// The track of each point.
  var tracks: [Int]
  var directions: [PointDirection] = []
  /// The observation that each direction stems from.
  var observations: [Int] = []

  init(_ tracks: [Int], _ map: SparseMap, _ rotations: [Quaternion?]) {
    self.tracks = tracks
    for (point, track) in tracks.enumerated() {
      for index in map.tracks.observations(of: track) {
        let photo = map.tracks.photos[index]
        guard let rotation = rotations[Int(photo)] else { continue }
        let ray = map.photos.cameras[Int(map.photos.cameraOfPhoto[Int(photo)])]
          .unproject(map.tracks.pixels[index])
        directions.append(
          PointDirection(
            photo: photo, point: Int32(point),
            direction: rotation.conjugate * SIMD3(ray.x, ray.y, 1).normalized))
        observations.append(index)
      }
    }
  }
}

/// Global positioning: camera centers and points from viewing directions and known rotations.
extension GlobalMapping {
  /// Global positioning: registers the photos that have a rotation and creates points for some of
  /// the tracks. Returns false if no track is usable.
  func position(
    _ map: inout SparseMap, _ rotations: [Quaternion?], _ context: StageContext
  ) throws -> Bool {
    let seen = TrackDirections(chosenTracks(map, rotations), map, rotations)
    guard !seen.tracks.isEmpty else { return false }
    var random = SplitMix64(seed: options.seed)
    let start = options.initialHalfExtent
    let solution = try GlobalPositioning(options.positioning).run(
      seen.directions, centers: rotations.map { _ in random.position(within: start) },
      points: seen.tracks.map { _ in random.position(within: start) }, control: context.control)
    for photo in Set(seen.directions.map { Int($0.photo) }).sorted() {
      guard let rotation = rotations[photo] else { continue }
      map.register(
        photo,
        RigidTransform(rotation: rotation, translation: -(rotation * solution.centers[photo])))
    }
    for (track, point) in zip(seen.tracks, solution.points) { map.setPoint(track, point) }
    let least = cos(options.positionErrorDegrees * .pi / 180)
    for (direction, index) in zip(seen.directions, seen.observations) {
      let offset = solution.points[Int(direction.point)] - solution.centers[Int(direction.photo)]
      map.isActive[index] = offset.normalized.dot(direction.direction) >= least
    }
    for track in seen.tracks where map.activeObservations(of: track).count < 2 {
      map.dropPoint(track)
    }
    return true
  }

  /// Selects tracks for global positioning: the longest first, until every photo observes enough of
  /// them.
  private func chosenTracks(_ map: SparseMap, _ rotations: [Quaternion?]) -> [Int] {
    let lengths = (0..<map.tracks.count).map { track in
      map.tracks.observations(of: track).count { rotations[Int(map.tracks.photos[$0])] != nil }
    }
    let candidates = lengths.indices.filter { lengths[$0] >= options.minimumTrackLength }
      .sorted { (-lengths[$0], $0) < (-lengths[$1], $1) }
    var counts = [Int](repeating: 0, count: rotations.count)
    let chosen = candidates.filter { track in
      let photos = map.tracks.observations(of: track).map { Int(map.tracks.photos[$0]) }
        .filter { rotations[$0] != nil }
      guard photos.contains(where: { counts[$0] < options.pointsPerPhoto }) else { return false }
      for photo in photos { counts[photo] += 1 }
      return true
    }
    return chosen.sorted()
  }

  /// Fixes the gauge: moves the world frame to a photo of the pair with the best-conditioned
  /// points, which bundle adjustment holds constant, and scales the pair's baseline to unit length.
  func fixGauge(_ map: inout SparseMap, _ graph: ViewGraph) {
    let registered = Set(map.registered)
    let best = graph.pairs.enumerated().filter { _, pair in
      registered.contains(pair.pair.first.index) && registered.contains(pair.pair.second.index)
    }.max {
      let (a, b) = ($0.element, $1.element)
      return (Double(a.matches.count) * min(a.medianAngle, options.saturationAngle), -$0.offset)
        < (Double(b.matches.count) * min(b.medianAngle, options.saturationAngle), -$1.offset)
    }
    guard let pair = best?.element.pair, let first = map.photos.poses[pair.first.index],
      let second = map.photos.poses[pair.second.index]
    else { return }
    let length = (second.center - first.center).length
    guard length > 0 else { return }
    let scale = 1 / length
    let photoFromWorld = SimilarityTransform(
      scale: scale, rotation: first.rotation, translation: scale * first.translation)
    let others = map.registered.filter { $0 != pair.first.index && $0 != pair.second.index }
    for photo in map.registered {
      map.photos.poses[photo] = map.photos.poses[photo].map(photoFromWorld.applied)
    }
    map.registered = [pair.first.index, pair.second.index] + others
    for track in map.positions.indices where map.isTriangulated[track] {
      map.positions[track] = photoFromWorld * map.positions[track]
    }
  }

  /// Adjusts the selected points with increasingly strict error limits, then triangulates all
  /// tracks. Removes photos that contradict the points they observe.
  func refine(_ map: inout SparseMap, _ context: StageContext) throws {
    let all = Array(map.isTriangulated.indices)
    let initialCameras = map.photos.cameras
    var points = PointTriangulation(
      options: .init(
        maximumError: growth.growthError, minimumAngleDegrees: growth.minimumAngleDegrees))
    for (round, factor) in options.errorFactors.enumerated() {
      try context.step(round, of: options.errorFactors.count + 1)
      let control = context.control.part(from: 0.5, to: 0.5)
      var adjustment = MapAdjustment(options: growth.adjustment, initialCameras: initialCameras)
      adjustment.options.huberWidth *= factor
      try adjustment.adjustGlobally(&map, control)
      points.options.maximumError = factor * growth.growthError
      try points.filter(all, in: &map, control)
    }
    points.options.maximumError = growth.growthError
    try points.triangulate(all, in: &map, context.control.part(from: 0.8, to: 0.9))
    try points.complete(all, in: &map, context.control.part(from: 0.9, to: 1))
    dropContradictingPhotos(&map)
  }

  /// Removes the photos that agree with too few of the points they observe.
  private func dropContradictingPhotos(_ map: inout SparseMap) {
    let bad = map.registered.filter { photo in
      let seen = map.tracks.observationsOfPhoto[photo]
        .filter { map.isTriangulated[Int(map.tracks.trackOfObservation[Int($0)])] }
      let active = seen.count { map.isActive[Int($0)] }
      return active < growth.minimumInliers
        || Double(active) < options.minimumPhotoShare * Double(seen.count)
    }
    for photo in bad { map.remove(photo) }
  }
}

extension SplitMix64 {
  /// A random position in a cube around the origin, given by half its side.
  fileprivate mutating func position(within halfExtent: Double) -> SIMD3<Double> {
    let (x, y, z) = (uniform(), uniform(), uniform())
    return halfExtent * (2 * SIMD3(x, y, z) - 1)
  }
}
