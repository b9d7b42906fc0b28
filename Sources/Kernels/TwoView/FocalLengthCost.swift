import CKernels
import SceneModel

/// The cost of focal-length hypotheses, from the matches of two photos of one camera.
package enum FocalLengthCost {
  /// For each factor, the sum of min(Sampson error², limit²) of the best pose when the focal length
  /// is the factor times the assumed one.
  ///
  /// Points are at depth 1 for the assumed focal length; `fundamental` is their fundamental matrix.
  package static func costs(
    _ first: [SIMD2<Double>], _ second: [SIMD2<Double>], fundamental: Matrix3,
    maximumError: Double, factors: [Double], _ control: KernelControl
  ) throws -> [Double] {
    guard first.count == second.count else {
      throw KernelError.invalidArgument("the two lists of points differ in length")
    }
    var costs = [Double](repeating: 0, count: factors.count)
    try withKernel(control) { control in
      withCoordinates(first) { points in
        withCoordinates(second) { others in
          ck_focal_length_costs(
            points.baseAddress, others.baseAddress, first.count, fundamental.elements,
            maximumError, factors, factors.count, control, &costs)
        }
      }
    }
    return costs
  }
}
