import Kernels
import SceneModel

/// Makes, completes and removes the points of a map.
struct PointTriangulation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Largest reprojection error in pixels.
    var maximumError = 4.0
    /// Smallest angle in degrees between two rays of a point.
    var minimumAngleDegrees = 1.5
  }

  var options = Options()

  private var minimumAngle: Double { options.minimumAngleDegrees * .pi / 180 }

  /// Triangulates those of the given tracks that have no point yet; returns how many got one.
  @discardableResult
  func triangulate(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    var batch = TrackObservations()
    var chosen: [Int] = []
    var indices: [Int] = []
    for track in candidates where !map.isTriangulated[track] {
      let seen = map.tracks.observations(of: track)
        .filter { map.isRegistered(Int(map.tracks.photos[$0])) }
      guard seen.count >= 2 else { continue }
      batch.append(seen.map { map.pointObservation($0, point: track) })
      chosen.append(track)
      indices += seen
    }
    var kernel = Triangulation.Options()
    (kernel.maximumError, kernel.minimumAngle) = (options.maximumError, minimumAngle)
    let result = try Triangulation(kernel).run(batch, photos: map.photos, control: control)
    var count = 0
    for (track, position) in zip(chosen, result.positions) {
      guard let position else { continue }
      map.setPoint(track, position)
      count += 1
    }
    for (index, isInlier) in zip(indices, result.isInlier) { map.isActive[index] = isInlier }
    return count
  }

  /// Lets the points of the given tracks gain the observations that agree with them; returns how
  /// many.
  @discardableResult
  func complete(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    var batch = TrackObservations()
    var positions: [SIMD3<Double>] = []
    var indices: [Int] = []
    for track in candidates where map.isTriangulated[track] {
      let missing = map.tracks.observations(of: track)
        .filter { !map.isActive[$0] && map.isRegistered(Int(map.tracks.photos[$0])) }
      guard !missing.isEmpty else { continue }
      batch.append(missing.map { map.pointObservation($0, point: track) })
      positions.append(map.positions[track])
      indices += missing
    }
    let (errors, _) = try Triangulation.measure(
      batch, positions: positions, photos: map.photos, maximumError: options.maximumError,
      control: control)
    var count = 0
    for (index, error) in zip(indices, errors) where error <= options.maximumError {
      map.isActive[index] = true
      count += 1
    }
    return count
  }

  /// Removes observations that are off by more than the limit, and points that are left with fewer
  /// than two or seen at too narrow an angle; returns how many observations went.
  @discardableResult
  func filter(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    let tracks = candidates.filter { map.isTriangulated[$0] }
    var batch = TrackObservations()
    var indices: [Int] = []
    for track in tracks {
      let active = map.activeObservations(of: track)
      batch.append(active.map { map.pointObservation($0, point: track) })
      indices += active
    }
    let (errors, angles) = try Triangulation.measure(
      batch, positions: tracks.map { map.positions[$0] }, photos: map.photos,
      maximumError: options.maximumError, control: control)
    var count = 0
    for (index, error) in zip(indices, errors) where !(error <= options.maximumError) {
      map.isActive[index] = false
      count += 1
    }
    for (track, angle) in zip(tracks, angles) {
      let left = map.tracks.observations(of: track).count { map.isActive[$0] }
      if left < 2 || angle < minimumAngle {
        count += left
        map.dropPoint(track)
      }
    }
    return count
  }
}
