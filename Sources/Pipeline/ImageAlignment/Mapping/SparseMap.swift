import Kernels
import SceneModel

/// A reconstruction in progress: poses of some photos, and points of some tracks.
struct SparseMap: Sendable {
  /// Tracks of a unit of parallel work. Chosen: some milliseconds; results do not depend on it.
  static let tracksPerUnit = 2048

  var photos: PosedPhotos
  private(set) var tracks: FeatureTracks
  /// The point of each track; valid if `isTriangulated`.
  var positions: [SIMD3<Double>]
  private(set) var isTriangulated: [Bool]
  private(set) var pointCount = 0
  /// Whether each observation of the tracks supports its track's point.
  var isActive: [Bool]
  /// How precise each observation of the tracks is.
  private var whitenings: [Whitening]
  /// Photos in the order of registration.
  var registered: [Int] = []
  /// Photos that observe a point that was added or removed since `takeChangedPhotos`, each once.
  private var changedPhotos: [Int] = []
  private var isChanged: [Bool]

  init(cameras: [Camera], photos: [Photo], tracks: FeatureTracks) {
    self.photos = PosedPhotos(cameras: cameras, unposed: photos)
    self.tracks = tracks
    positions = Array(repeating: .zero, count: tracks.count)
    isTriangulated = Array(repeating: false, count: tracks.count)
    isActive = Array(repeating: false, count: tracks.photos.count)
    whitenings = Array(repeating: .identity, count: tracks.photos.count)
    isChanged = photos.map { _ in false }
  }

  func isRegistered(_ photo: Int) -> Bool { photos.poses[photo] != nil }

  /// Registers a photo, or moves a registered one.
  mutating func register(_ photo: Int, _ cameraFromWorld: RigidTransform) {
    if photos.poses[photo] == nil { registered.append(photo) }
    photos.poses[photo] = cameraFromWorld
  }

  /// Unregisters a photo, deactivates its observations, and drops the points that fewer than two
  /// other photos support.
  mutating func remove(_ photo: Int) {
    photos.poses[photo] = nil
    registered.removeAll { $0 == photo }
    for index in tracks.observationsOfPhoto[photo] { isActive[Int(index)] = false }
    noteChange(ofPhoto: photo)
    for track in tracks(ofPhoto: photo) where isTriangulated[track] {
      if activeObservations(of: track).count < 2 { dropPoint(track) }
    }
  }

  /// Sets or moves the point of a track.
  mutating func setPoint(_ track: Int, _ position: SIMD3<Double>) {
    positions[track] = position
    guard !isTriangulated[track] else { return }
    isTriangulated[track] = true
    pointCount += 1
    noteChange(of: track)
  }

  /// Removes the point of a track and deactivates its observations.
  mutating func dropPoint(_ track: Int) {
    for index in tracks.observations(of: track) { isActive[index] = false }
    guard isTriangulated[track] else { return }
    isTriangulated[track] = false
    pointCount -= 1
    noteChange(of: track)
  }

  private mutating func noteChange(of track: Int) {
    for index in tracks.observations(of: track) { noteChange(ofPhoto: Int(tracks.photos[index])) }
  }

  private mutating func noteChange(ofPhoto photo: Int) {
    guard !isChanged[photo] else { return }
    isChanged[photo] = true
    changedPhotos.append(photo)
  }

  /// Returns and clears the photos that observe a point added or removed since the last call.
  mutating func takeChangedPhotos() -> [Int] {
    for photo in changedPhotos { isChanged[photo] = false }
    defer { changedPhotos = [] }
    return changedPhotos
  }

  /// The indices of the observations that support the track's point.
  func activeObservations(of track: Int) -> [Int] {
    tracks.observations(of: track).filter { isActive[$0] }
  }

  /// The observations of some tracks, and their indices, without those for which `isLeftOut` is
  /// true. Points have the numbers of the tracks in `chosen`.
  func observations(
    of chosen: [Int], _ control: KernelControl,
    leavingOut isLeftOut: @escaping @Sendable (SparseMap, Int) -> Bool
  ) throws -> (batch: TrackObservations, indices: [Int]) {
    let parts = try control.withoutProgress
      .parallelMap(chosen.indices, perUnitOf: Self.tracksPerUnit) { points in
        var (batch, indices) = (TrackObservations(), [Int]())
        for point in points {
          for index in tracks.observations(of: chosen[point]) where !isLeftOut(self, index) {
            batch.append(pointObservation(index, point: point))
            indices.append(index)
          }
          batch.endTrack()
        }
        return (batch, indices)
      }
    return (TrackObservations(joining: parts.map(\.0)), Array(parts.map(\.1).joined()))
  }

  /// The number of observations of a photo that support a point.
  func activeCount(ofPhoto photo: Int) -> Int {
    tracks.observationsOfPhoto[photo].count { isActive[Int($0)] }
  }

  /// Moves an observation within its photo.
  mutating func moveObservation(_ index: Int, to pixel: SIMD2<Double>, _ whitening: Whitening) {
    tracks.movePixel(of: index, to: pixel)
    whitenings[index] = whitening
  }

  /// An observation of a track.
  struct Member {
    var photo: Int32
    var feature: Int32
    var pixel: SIMD2<Double>
    var whitening: Whitening
    var isActive: Bool
  }

  func member(_ index: Int) -> Member {
    Member(
      photo: tracks.photos[index], feature: tracks.features[index], pixel: tracks.pixels[index],
      whitening: whitenings[index], isActive: isActive[index])
  }

  /// Replaces the observations of all tracks; their points stay.
  mutating func replaceTracks(_ members: [[Member]]) {
    tracks = FeatureTracks(photoCount: photos.poses.count)
    for track in members { tracks.append(track.map { ($0.photo, $0.feature, $0.pixel) }) }
    isActive = members.flatMap { $0.map(\.isActive) }
    whitenings = members.flatMap { $0.map(\.whitening) }
  }

  /// An observation for the kernels; `point` is the index of its point in their arrays.
  func pointObservation(_ index: Int, point: Int) -> PointObservation {
    PointObservation(
      photo: tracks.photos[index], point: Int32(point), pixel: tracks.pixels[index],
      whitening: whitenings[index])
  }

  /// The tracks that `photo` observes, triangulated or not, in ascending order.
  func tracks(ofPhoto photo: Int) -> [Int] {
    tracks.observationsOfPhoto[photo].map { Int(tracks.trackOfObservation[Int($0)]) }
  }

  /// Moves the observations of registered photos that contradict their track's point to a new
  /// track, if there are at least two of them.
  mutating func splitTracks() {
    var members: [[Member]] = []
    var newPositions: [SIMD3<Double>] = []
    var newTriangulated: [Bool] = []
    for track in 0..<tracks.count {
      let all = Array(tracks.observations(of: track))
      let outliers =
        isTriangulated[track]
        ? all.filter { !isActive[$0] && isRegistered(Int(tracks.photos[$0])) } : []
      let kept = outliers.count >= 2 ? all.filter { !outliers.contains($0) } : all
      members.append(kept.map(member))
      newPositions.append(positions[track])
      newTriangulated.append(isTriangulated[track])
      if outliers.count >= 2 {
        members.append(outliers.map(member))
        newPositions.append(.zero)
        newTriangulated.append(false)
      }
    }
    replaceTracks(members)
    (positions, isTriangulated) = (newPositions, newTriangulated)
  }
}

extension PosedPhotos {
  /// Photos without poses.
  init(cameras: [Camera], unposed photos: [Photo]) {
    self.init(
      cameras: cameras, poses: photos.map { _ in nil },
      cameraOfPhoto: photos.map { $0.camera.rawValue })
  }
}
