import CKernels

/// Radius search among the points of a set.
package enum PointNeighbors {
  /// For each point, whether at least `minimum` others are within its radius; false for one that is
  /// not finite. `radii` has one element per point, in units of the coordinates. Throws
  /// `KernelError`, and `CancellationError`.
  package static func atLeast(
    _ minimum: Int, of points: [SIMD3<Float>], within radii: [Float], _ control: KernelControl
  ) throws -> [Bool] {
    guard radii.count == points.count else {
      throw KernelError.invalidArgument("points and radii differ in number")
    }
    guard minimum > 0 else { return points.map(\.isFinite) }
    var found = [UInt8](repeating: 0, count: points.count)
    try withKernel(control) { control in
      points.withSpan { ck_have_neighbors($0, radii, minimum, control, &found) }
    }
    return found.map { $0 != 0 }
  }
}
