import Foundation
import SceneModel

/// The typical change of the local feature frames (scale and orientation) between the two photos of
/// a pair, estimated from its known matches; chance matches deviate from it.
struct LocalFrames {
  private let first: FeatureSet
  private let second: FeatureSet
  /// Median logarithm of the scale ratio.
  private var scale = 0.0
  /// Mean rotation as a vector; the shorter it is, the larger the spread.
  private var turn = SIMD2<Double>.zero

  /// Maximum deviation from the median scale ratio, as a factor, and from the mean rotation, in
  /// degrees. Chosen.
  private static let maximumFactor = 2.0
  private static let maximumTurnDegrees = 45.0
  /// Length of the mean rotation vector below which rotations vary too much to be a criterion.
  /// Chosen.
  private static let minimumAgreement = 0.5

  init(_ known: [FeatureMatch], _ first: FeatureSet, _ second: FeatureSet) {
    (self.first, self.second) = (first, second)
    scale = known.map(logarithmOfScales).upperMedian ?? 0
    turn = known.reduce(SIMD2<Double>.zero) { $0 + direction($1) } / Double(max(1, known.count))
  }

  private func logarithmOfScales(_ match: FeatureMatch) -> Double {
    log(Double(second.scales[Int(match.second)] / first.scales[Int(match.first)]))
  }

  private func direction(_ match: FeatureMatch) -> SIMD2<Double> {
    let angle = Double(
      second.orientations[Int(match.second)] - first.orientations[Int(match.first)])
    return [cos(angle), sin(angle)]
  }

  /// Whether a match changes scale and orientation like the known ones.
  func agrees(_ match: FeatureMatch) -> Bool {
    guard abs(logarithmOfScales(match) - scale) <= log(Self.maximumFactor) else { return false }
    let length = (turn * turn).sum().squareRoot()
    guard length >= Self.minimumAgreement else { return true }
    return (direction(match) * turn).sum() >= cos(Self.maximumTurnDegrees * .pi / 180) * length
  }
}
