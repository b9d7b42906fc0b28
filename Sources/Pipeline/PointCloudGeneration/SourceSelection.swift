import Foundation
import SceneModel

/// Chooses the views that a reference view is compared with: those that share many sparse points
/// seen at a good angle and a similar scale (Goesele et al., ICCV 2007; Schönberger et al., 2016).
struct SourceSelection {
  struct Options: Hashable, Codable, Sendable {
    var maximumSources = 8
    /// Triangulation angle in degrees that is best for stereo.
    var bestAngleDegrees = 11.0
    /// Widths, in degrees, of the bell below and above the best angle.
    var narrowWidthDegrees = 5.0
    var wideWidthDegrees = 14.0
    /// Views that share fewer points are no sources.
    var minimumSharedPoints = 5
  }

  var options = Options()

  /// For each photo id its sources, the best first; empty for photos that are not registered.
  func run(_ reconstruction: Reconstruction) -> [[ID<Photo>]] {
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
    return (0..<count).map { photo in
      (0..<count)
        .filter { shared[photo][$0] >= options.minimumSharedPoints && scores[photo][$0] > 0 }
        .sorted { (-scores[photo][$0], $0) < (-scores[photo][$1], $1) }
        .prefix(options.maximumSources).map { ID($0) }
    }
  }

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
