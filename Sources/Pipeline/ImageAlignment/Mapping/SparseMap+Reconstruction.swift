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
    let unit = 2048  // Tracks of a unit of parallel work. Chosen: a few milliseconds.
    return try control.withoutProgress.parallelMap(tracks.count, inUnitsOf: unit) { [self] in
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
    let (batch, _) = observations(of: triangulated) { !isActive[$0] }
    let (errors, _) = try Triangulation.measure(
      batch, positions: triangulated.map { positions[$0] }, photos: photos, maximumError: 1,
      control: control)
    return errors.upperMedian ?? 0
  }

  /// Drops points with fewer than two active observations.
  mutating func dropUnsupportedPoints() {
    for track in 0..<tracks.count where isTriangulated[track] {
      if activeObservations(of: track).count < 2 { dropPoint(track) }
    }
  }

  /// Adds observations to tracks, or replaces inactive observations of the same photos.
  mutating func add(_ additions: [NewObservation]) {
    var added = [[NewObservation]](repeating: [], count: tracks.count)
    for addition in additions { added[addition.track].append(addition) }
    var members: [[Member]] = []
    for track in 0..<tracks.count {
      let new = Set(added[track].map { Int32($0.photo) })
      let known = tracks.observations(of: track).filter { !new.contains(tracks.photos[$0]) }
        .map(member)
      let found = added[track].map {
        Member(
          photo: Int32($0.photo), feature: Self.noFeature, pixel: $0.pixel,
          whitening: $0.whitening, isActive: true)
      }
      members.append((known + found).sorted { $0.photo < $1.photo })
    }
    replaceTracks(members)
  }
}
