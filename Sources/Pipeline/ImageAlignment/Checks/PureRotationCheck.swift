import Foundation
import SceneModel

/// Detects sets in which all photos were taken from one place and the camera was only rotated.
///
/// Such photos contain no depth information, yet with a free focal length a map can be fitted to
/// them. Pure rotation preserves the angles between the rays of all points, so the angle between
/// two points of one photo is compared with the angle between their matches in the other, for a
/// range of focal lengths.
package struct PureRotationCheck: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Focal lengths range from the given one divided by this to the one multiplied by it, for
    /// assumed values and for values from metadata. Chosen.
    package var assumedRange = SelfCalibration.Options().range
    package var exifRange = 1.15
    /// Number of focal lengths tested, evenly spaced in their logarithms. Chosen.
    package var candidates = 81
    /// Maximum number of matches used per pair. Chosen.
    package var maximumMatches = 200
    /// Maximum number of pairs used, those with the most matches. Chosen.
    package var maximumPairs = 60
    /// Maximum median change of angles explained by noise, as a fraction of the photo's longer
    /// side. Chosen.
    package var relativeError = 0.002
    /// Minimum fraction of the pairs that must be pure rotations. Chosen.
    package var pureRotationShare = 0.9

    package init() {}
  }

  /// The matches of a pair at depth 1 (relative to the principal points, in units of the focal
  /// lengths).
  private struct Sample: Sendable {
    var first: [SIMD2<Double>]
    var second: [SIMD2<Double>]
    /// Maximum median change of angles under pure rotation at the given focal length, in radians.
    var limit: Double
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Whether the matches are consistent with a camera that only rotated.
  package func isPureRotation(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], cameras: [Camera]
  ) -> Bool {
    let pairs = graph.strongestPairs().prefix(options.maximumPairs)
    let samples = pairs.map { sample($0, features, photos, cameras) }
    guard !samples.isEmpty else { return false }
    let isAssumed = cameras.contains { $0.calibration == .assumed }
    let range = log(isAssumed ? options.assumedRange : options.exifRange)
    let steps = max(1, options.candidates - 1)
    return (0...steps).contains { step in
      let factor = exp(range * (2 * Double(step) / Double(steps) - 1))
      let turned = samples.count { medianChange($0, factor) <= $0.limit / factor }
      return Double(turned) >= options.pureRotationShare * Double(samples.count)
    }
  }

  private func sample(
    _ pair: VerifiedPair, _ features: [FeatureSet], _ photos: [Photo], _ cameras: [Camera]
  ) -> Sample {
    let (first, second) = (pair.pair.first.index, pair.pair.second.index)
    let matches = pair.thinnedMatches(options.maximumMatches)
    let camera = cameras[photos[first].camera.index]
    let otherCamera = cameras[photos[second].camera.index]
    let pixels = options.relativeError * camera.longerSide
    return Sample(
      first: camera.normalizedPositions(of: matches, in: features[first], \.first),
      second: otherCamera.normalizedPositions(of: matches, in: features[second], \.second),
      limit: pixels / camera.focalLength.x)
  }

  /// The median change, in radians, of the angle between two points, with the focal lengths
  /// multiplied by `factor`.
  private func medianChange(_ sample: Sample, _ factor: Double) -> Double {
    func rays(_ points: [SIMD2<Double>]) -> [SIMD3<Double>] {
      points.map { SIMD3($0.x / factor, $0.y / factor, 1).normalized }
    }
    let (first, second) = (rays(sample.first), rays(sample.second))
    let half = first.count / 2
    let changes = (0..<half).map { i in
      abs(angle(first[i], first[i + half]) - angle(second[i], second[i + half]))
    }
    return changes.upperMedian ?? .infinity
  }

  private func angle(_ a: SIMD3<Double>, _ b: SIMD3<Double>) -> Double {
    atan2(a.cross(b).length, a.dot(b))
  }
}
