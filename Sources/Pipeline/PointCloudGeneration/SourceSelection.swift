import Foundation
import Kernels
import SceneModel

/// Selects the source views of each reference view: those that share many sparse points seen at a
/// suitable triangulation angle and a similar scale (Goesele et al., ICCV 2007; Schönberger et al.,
/// 2016).
struct SourceSelection {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum number of sources of a view. Limit: `PatchStereo.maximumSources`.
    var maximumSources = 8
    /// Optimal triangulation angle for stereo in degrees. Chosen.
    var bestAngleDegrees = 11.0
    /// Standard deviations, in degrees, of the Gaussian weight below and above the optimal angle.
    /// Chosen.
    var narrowWidthDegrees = 5.0
    var wideWidthDegrees = 14.0
    /// Views that share fewer points are not sources. Chosen.
    var minimumSharedPoints = 5
  }

  var options = Options()

  /// The sources of each photo by id, best first; empty for photos that are not registered.
  /// Photos that are blurred at a size of `viewPixels` count less.
  func run(
    _ reconstruction: Reconstruction, viewPixels: Int, _ control: KernelControl = KernelControl()
  ) throws -> [[ID<Photo>]] {
    var points = [[Int32]](repeating: [], count: reconstruction.photos.count)
    for (index, point) in reconstruction.points.enumerated() {
      for observation in point.track { points[observation.photo.index].append(Int32(index)) }
    }
    let centers = reconstruction.poses.map { $0?.center }
    let detail = reconstruction.photos.map { $0.detail(at: viewPixels) }
    return try control.parallelMap(points.count, inUnitsOf: 16) { [points] photos in
      photos.map { sources(of: $0, seeing: points[$0], of: reconstruction, centers, detail) }
    }
  }

  /// The sources of a photo, given the numbers of the points that it observes, and the camera
  /// centers and the detail of all photos.
  private func sources(
    of photo: Int, seeing points: [Int32], of reconstruction: Reconstruction,
    _ centers: [SIMD3<Double>?], _ detail: [Double]
  ) -> [ID<Photo>] {
    guard let center = centers[photo] else { return [] }
    var scores = [Double](repeating: 0, count: centers.count)
    var shared = [Int](repeating: 0, count: centers.count)
    var others: [Int] = []
    for index in points {
      let point = reconstruction.points[Int(index)]
      for observation in point.track where observation.photo.index != photo {
        let other = observation.photo.index
        guard let otherCenter = centers[other] else { continue }
        let weight = weight(of: point.position, from: center, and: otherCenter)
        guard weight.isFinite else { continue }
        if shared[other] == 0 { others.append(other) }
        scores[other] += weight
        shared[other] += 1
      }
    }
    for other in others { scores[other] *= detail[other] }
    return others.filter { shared[$0] >= options.minimumSharedPoints && scores[$0] > 0 }
      .sorted { (-scores[$0], $0) < (-scores[$1], $1) }
      .prefix(options.maximumSources).map { ID($0) }
  }

  /// Gaussian weight of the triangulation angle, times the squared ratio of distances.
  private func weight(
    of point: SIMD3<Double>, from a: SIMD3<Double>, and b: SIMD3<Double>
  ) -> Double {
    let (u, v) = (a - point, b - point)
    let angle = atan2(u.cross(v).length, u.dot(v)) * 180 / .pi
    let width =
      angle < options.bestAngleDegrees ? options.narrowWidthDegrees : options.wideWidthDegrees
    let deviation = (angle - options.bestAngleDegrees) / width
    let ratio = min(u.length, v.length) / max(u.length, v.length, .leastNonzeroMagnitude)
    return exp(-deviation * deviation / 2) * ratio * ratio
  }
}
