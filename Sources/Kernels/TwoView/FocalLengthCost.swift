import CKernels
import SceneModel

/// The cost of focal-length hypotheses, from the matches of two photos of one camera.
package enum FocalLengthCost {
  /// For each factor, the sum of min(Sampson error², limit²), in squared units of the points, of
  /// the best pose when the focal length is the factor times the assumed one.
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
    let m = (fundamental.row0, fundamental.row1, fundamental.row2)
    var options = ck_focal_length_options(
      fundamental: (m.0.x, m.0.y, m.0.z, m.1.x, m.1.y, m.1.z, m.2.x, m.2.y, m.2.z),
      maximum_error: maximumError)
    try withKernel(control) { control in
      withPairs(first, second) {
        ck_focal_length_costs($0, factors, factors.count, &options, control, &costs)
      }
    }
    return costs
  }
}
