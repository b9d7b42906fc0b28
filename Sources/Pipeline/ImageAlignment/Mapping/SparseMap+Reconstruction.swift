import Kernels
import SceneModel

/// Conversion between a map and a reconstruction.
extension SparseMap {
  /// A new observation of a track.
  struct NewObservation: Hashable, Sendable {
    var track: Int
    var photo: Int
    var pixel: SIMD2<Double>
    var whitening: Whitening
  }

  /// The feature index of an observation without a feature.
  static let noFeature: Int32 = -1

  /// The map of a reconstruction: all its photos are registered, all its observations active.
  init(_ reconstruction: Reconstruction) {
    var tracks = FeatureTracks(photoCount: reconstruction.photos.count)
    for point in reconstruction.points {
      tracks.append(point.track.map { ($0.photo.rawValue, $0.feature, $0.pixel) })
    }
    self.init(cameras: reconstruction.cameras, photos: reconstruction.photos, tracks: tracks)
    for photo in reconstruction.registered {
      if let pose = reconstruction.poses[photo.index] { register(photo.index, pose) }
    }
    for (track, point) in reconstruction.points.enumerated() { setPoint(track, point.position) }
    isActive = isActive.map { _ in true }
  }

  /// The current map as a reconstruction; what the map doesn't hold is copied from `other`.
  func reconstruction(
    like other: Reconstruction, features: [FeatureSet], _ control: KernelControl
  ) throws -> Reconstruction {
    var result = other
    result.poses = photos.poses
    for (index, camera) in photos.cameras.enumerated() {
      let calibration = result.cameras[index].calibration
      result.cameras[index] = camera
      result.cameras[index].calibration = calibration
    }
    result.points = try scenePoints(features, control)
    return result
  }

  /// The scene points of all triangulated tracks, in their order.
  func scenePoints(_ features: [FeatureSet], _ control: KernelControl) throws -> [ScenePoint] {
    try control.withoutProgress.parallelMap(tracks.count, inUnitsOf: Self.tracksPerUnit) {
      $0.filter { isTriangulated[$0] }.map { scenePoint($0, features) }
    }
  }

  /// The scene point of a track with its color, error and active observations.
  private func scenePoint(_ track: Int, _ features: [FeatureSet]) -> ScenePoint {
    var point = ScenePoint(position: positions[track])
    var (color, colored, error) = (SIMD3<Int>.zero, 0, 0.0)
    for index in activeObservations(of: track) {
      let (photo, feature) = (Int(tracks.photos[index]), tracks.features[index])
      point.track.append(
        Observation(photo: ID(photo), feature: feature, pixel: tracks.pixels[index]))
      if let pose = photos.poses[photo] {
        let camera = photos.cameras[Int(photos.cameraOfPhoto[photo])]
        error += (camera.project(pose * point.position) - tracks.pixels[index]).length
      }
      if features[photo].colors.indices.contains(Int(feature)) {
        color &+= SIMD3<Int>(truncatingIfNeeded: features[photo].colors[Int(feature)])
        colored += 1
      }
    }
    point.error = error / Double(max(1, point.track.count))
    point.color = SIMD3<UInt8>(clamping: color / max(1, colored))
    return point
  }

  /// The median reprojection error of the active observations in pixels; 0 without any.
  func medianError(_ control: KernelControl) throws -> Double {
    let triangulated = isTriangulated.indices.filter { isTriangulated[$0] }
    let (batch, _) = try observations(of: triangulated, control) { !$0.isActive[$1] }
    let (errors, _) = try Triangulation.measure(
      batch, positions: triangulated.map { positions[$0] }, photos: photos, maximumError: 1,
      control: control)
    return errors.upperMedian ?? 0
  }

  /// Drops points with fewer than two active observations.
  mutating func dropUnsupportedPoints() {
    for track in 0..<tracks.count where isTriangulated[track] {
      if tracks.observations(of: track).count(where: { isActive[$0] }) < 2 { dropPoint(track) }
    }
  }

  /// Adds observations to tracks, or replaces inactive observations of the same photos.
  mutating func add(_ additions: [NewObservation], _ control: KernelControl) throws {
    let added = additions.reduce(into: [[NewObservation]](repeating: [], count: tracks.count)) {
      $0[$1.track].append($1)
    }
    replaceTracks(
      try control.withoutProgress.parallelMap(tracks.count, inUnitsOf: Self.tracksPerUnit) {
        [self] in $0.map { members(of: $0, with: added[$0]) }
      })
  }

  /// The observations of a track with new ones, which replace those of the same photos.
  private func members(of track: Int, with added: [NewObservation]) -> [Member] {
    let known = tracks.observations(of: track)
      .filter { index in !added.contains { Int32($0.photo) == tracks.photos[index] } }
    let found = added.map {
      Member(
        photo: Int32($0.photo), feature: Self.noFeature, pixel: $0.pixel,
        whitening: $0.whitening, isActive: true)
    }
    return (known.map(member) + found).sorted { $0.photo < $1.photo }
  }
}
