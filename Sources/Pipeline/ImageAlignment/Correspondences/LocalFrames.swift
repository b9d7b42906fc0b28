import Foundation
import SceneModel

/// How the local frames of a pair's known matches, the scales and orientations of their features, change
/// from the first photo to the second: chance matches change otherwise.
struct LocalFrames {
  private let first: FeatureSet
  private let second: FeatureSet
  /// The median of the logarithm of the ratio of scales.
  private var scale = 0.0
  /// The mean turn, as a vector: the shorter, the less it says.
  private var turn = SIMD2<Double>.zero

  /// Largest change from the median as a factor, and from the mean turn in degrees.
  private static let maximumFactor = 2.0
  private static let maximumTurnDegrees = 45.0
  /// Length of the mean turn below which turns differ too much to judge by.
  private static let minimumAgreement = 0.5

  init(_ known: [FeatureMatch], _ first: FeatureSet, _ second: FeatureSet) {
    (self.first, self.second) = (first, second)
    let ratios = known.map(logarithmOfScales).sorted()
    scale = ratios.isEmpty ? 0 : ratios[ratios.count / 2]
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

  func agrees(_ match: FeatureMatch) -> Bool {
    guard abs(logarithmOfScales(match) - scale) <= log(Self.maximumFactor) else { return false }
    let length = (turn * turn).sum().squareRoot()
    guard length >= Self.minimumAgreement else { return true }
    return (direction(match) * turn).sum() >= cos(Self.maximumTurnDegrees * .pi / 180) * length
  }
}
