import Foundation
import SceneModel

/// Errors of estimated poses with respect to ground truth.
package struct PoseErrors: Codable, Hashable, Sendable {
  /// Number of reference photos that have a pose in the result.
  package var registered: Int
  /// Number of reference photos.
  package var total: Int
  /// Root mean square, median and maximum distance between camera centers after alignment, in units
  /// of the reference.
  package var centerRMSE: Double
  package var centerMedian: Double
  package var centerMaximum: Double
  /// Mean and maximum angle between rotations after alignment.
  package var rotationMeanDegrees: Double
  package var rotationMaximumDegrees: Double
  /// Area under the recall curve of relative poses (AUC), 0…1; the error of a pair is the larger of
  /// its rotation error and the angle between its translation directions.
  package var areaUnderCurve: [AreaUnderCurve]

  /// The area from 0 to a threshold, divided by the threshold.
  package struct AreaUnderCurve: Codable, Hashable, Sendable {
    package var thresholdDegrees: Double
    package var value: Double
  }

  /// Thresholds of `areaUnderCurve`. Chosen.
  package static let thresholdsDegrees = [0.1, 0.5, 1, 5]
}

extension PoseErrors {
  /// Compares `result` with `reference`, with photos matched by `PhotoTable`. Also returns the
  /// similarity `referenceFromResult`.
  ///
  /// The result may contain photos rotated upright that the reference has in stored orientation;
  /// the quarter turn about the optical axis that best explains the relative rotations is applied
  /// to all poses. Throws `EvaluationError`.
  package static func comparing(
    _ result: [NamedCamera], with reference: [NamedCamera]
  ) throws -> (errors: PoseErrors, alignment: SimilarityTransform) {
    let estimates = PhotoTable(result.map { ($0.name, $0.cameraFromWorld) })
    let common = reference.compactMap { camera in
      estimates[camera.name].map { (truth: camera.cameraFromWorld, estimate: $0) }
    }
    guard !common.isEmpty else { throw EvaluationError.noCommonPhotos }
    let turn = bestTurn(common)
    let pairs = common.map { (truth: $0.truth, estimate: turn * $0.estimate) }
    let alignment = SimilarityAlignment().robust(
      from: pairs.map(\.estimate.center), to: pairs.map(\.truth.center))
    guard let alignment else {
      throw EvaluationError.undeterminedAlignment(commonPhotos: common.count)
    }
    let centers = pairs.map { (alignment * $0.estimate.center - $0.truth.center).length }.sorted()
    let rotations = pairs.map { pair in
      degrees(
        pair.truth.rotation * alignment.rotation * pair.estimate.rotation.conjugate)
    }
    let missing = reference.count - common.count
    let curve = relativeErrors(pairs, missing: missing, total: reference.count)
    let errors = PoseErrors(
      registered: common.count, total: reference.count,
      centerRMSE: (centers.reduce(0) { $0 + $1 * $1 } / Double(centers.count)).squareRoot(),
      centerMedian: centers.median, centerMaximum: centers.last ?? 0,
      rotationMeanDegrees: rotations.reduce(0, +) / Double(rotations.count),
      rotationMaximumDegrees: rotations.max() ?? 0,
      areaUnderCurve: thresholdsDegrees.map {
        AreaUnderCurve(thresholdDegrees: $0, value: area(under: curve, to: $0))
      })
    return (errors, alignment)
  }

  /// The angle of a rotation.
  private static func degrees(_ rotation: Quaternion) -> Double { rotation.angle * 180 / .pi }

  private typealias Pair = (truth: RigidTransform, estimate: RigidTransform)

  /// The quarter turn about the optical axis that best explains the relative rotations of
  /// successive photos; the identity unless another one is clearly better.
  private static func bestTurn(_ pairs: [Pair]) -> RigidTransform {
    let turns = (0..<4).map {
      RigidTransform(
        rotation: Quaternion(angle: Double($0) * .pi / 2, axis: [0, 0, 1]), translation: .zero)
    }
    func error(_ turn: RigidTransform) -> Double {
      zip(pairs, pairs.dropFirst()).reduce(0) { sum, neighbors in
        let (a, b) = neighbors
        let truth = b.truth.rotation * a.truth.rotation.conjugate
        let estimate = b.estimate.rotation * a.estimate.rotation.conjugate
        let turned = turn.rotation * estimate * turn.rotation.conjugate
        return sum + (truth.conjugate * turned).angle
      }
    }
    let errors = turns.map(error)
    let best = errors.indices.min { errors[$0] < errors[$1] } ?? 0
    return errors[best] < errors[0] - 1e-6 ? turns[best] : .identity
  }

  /// The sorted errors of all pairs of photos in degrees; 180 for pairs with a missing pose.
  private static func relativeErrors(_ pairs: [Pair], missing: Int, total: Int) -> [Double] {
    var errors: [Double] = []
    for first in pairs.indices {
      for second in pairs.indices where second > first {
        let (a, b) = (pairs[first], pairs[second])
        let truth = b.truth.rotation * a.truth.rotation.conjugate
        let estimate = b.estimate.rotation * a.estimate.rotation.conjugate
        let trueDirection = b.truth.rotation * (a.truth.center - b.truth.center)
        let direction = b.estimate.rotation * (a.estimate.center - b.estimate.center)
        let angle =
          atan2(
            trueDirection.cross(direction).length, trueDirection.dot(direction)) * 180 / .pi
        errors.append(max(degrees(truth.conjugate * estimate), angle))
      }
    }
    let all = total * (total - 1) / 2
    return errors.sorted() + [Double](repeating: 180, count: all - errors.count)
  }

  /// The area under the recall curve of sorted errors, with linear interpolation.
  static func area(under errors: [Double], to threshold: Double) -> Double {
    guard !errors.isEmpty else { return 0 }
    var (area, lastError, lastRecall) = (0.0, 0.0, 0.0)
    for (index, error) in errors.enumerated() {
      guard error < threshold else { break }
      let recall = Double(index + 1) / Double(errors.count)
      area += (error - lastError) * (recall + lastRecall) / 2
      (lastError, lastRecall) = (error, recall)
    }
    return (area + (threshold - lastError) * lastRecall) / threshold
  }
}
