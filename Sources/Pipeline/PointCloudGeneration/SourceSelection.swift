import Foundation
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
  func run(_ reconstruction: Reconstruction, viewPixels: Int) -> [[ID<Photo>]] {
    let count = reconstruction.photos.count
    var scores = [[Double]](repeating: [Double](repeating: 0, count: count), count: count)
    var shared = [[Int]](repeating: [Int](repeating: 0, count: count), count: count)
    let centers = reconstruction.poses.map { $0?.center }
    for point in reconstruction.points {
      for (position, first) in point.track.enumerated() {
        for second in point.track[(position + 1)...] {
          let (a, b) = (first.photo.index, second.photo.index)
          guard let c = centers[a], let d = centers[b] else { continue }
          let weight = weight(of: point.position, from: c, and: d)
          guard weight.isFinite else { continue }
          scores[a][b] += weight
          scores[b][a] += weight
          shared[a][b] += 1
          shared[b][a] += 1
        }
      }
    }
    let detail = reconstruction.photos.map { $0.detail(at: viewPixels) }
    for photo in 0..<count {
      for source in 0..<count { scores[photo][source] *= detail[source] }
    }
    return (0..<count).map { photo in
      (0..<count)
        .filter { shared[photo][$0] >= options.minimumSharedPoints && scores[photo][$0] > 0 }
        .sorted { (-scores[photo][$0], $0) < (-scores[photo][$1], $1) }
        .prefix(options.maximumSources).map { ID($0) }
    }
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
