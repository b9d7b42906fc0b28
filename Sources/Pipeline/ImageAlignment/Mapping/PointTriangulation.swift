import Kernels
import SceneModel

/// Triangulates, completes and filters the points of a map.
struct PointTriangulation: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum reprojection error in pixels. Chosen: as in `IncrementalMapping`.
    var maximumError = 4.0
    /// Minimum triangulation angle of a point in degrees. Chosen: as in `IncrementalMapping`.
    var minimumAngleDegrees = 1.5
  }

  var options = Options()

  private var minimumAngle: Double { options.minimumAngleDegrees * .pi / 180 }

  /// Triangulates the given tracks that have no point yet; returns how many succeeded.
  @discardableResult
  func triangulate(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    let chosen = candidates.filter { track in
      !map.isTriangulated[track]
        && map.tracks.observations(of: track)
          .count { map.isRegistered(Int(map.tracks.photos[$0])) } >= 2
    }
    let (batch, indices) = try map.observations(of: chosen, control) {
      !$0.isRegistered(Int($0.tracks.photos[$1]))
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

  /// Activates the observations of the given tracks that agree with their points; returns how many.
  @discardableResult
  func complete(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    let tracks = candidates.filter { map.isTriangulated[$0] }
    let (batch, indices) = try map.observations(of: tracks, control) {
      $0.isActive[$1] || !$0.isRegistered(Int($0.tracks.photos[$1]))
    }
    guard !indices.isEmpty else { return 0 }
    let (errors, _) = try Triangulation.measure(
      batch, positions: tracks.map { map.positions[$0] }, photos: map.photos,
      maximumError: options.maximumError, control: control)
    var count = 0
    for (index, error) in zip(indices, errors) where error <= options.maximumError {
      map.isActive[index] = true
      count += 1
    }
    return count
  }

  /// Deactivates observations whose error exceeds the limit, and removes points with fewer than two
  /// remaining observations or too small a triangulation angle; returns how many observations were
  /// deactivated.
  @discardableResult
  func filter(
    _ candidates: [Int], in map: inout SparseMap, _ control: KernelControl
  ) throws -> Int {
    let tracks = candidates.filter { map.isTriangulated[$0] }
    let (batch, indices) = try map.observations(of: tracks, control) { !$0.isActive[$1] }
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
