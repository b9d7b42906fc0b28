import CKernels

/// Which points of a set have others near them.
package enum PointNeighbors {
  /// For each point, whether at least `minimum` others are up to its distance away; false for one
  /// that is not finite. `distances` has one element per point.
  package static func areEnough(
    _ minimum: Int, of points: [SIMD3<Float>], within distances: [Float], _ control: KernelControl
  ) throws -> [Bool] {
    guard distances.count == points.count, minimum >= 0 else {
      throw KernelError.invalidArgument("points and distances differ in number")
    }
    var found = [UInt8](repeating: 0, count: points.count)
    try withKernel(control) { control in
      points.withSpan { ck_have_neighbors($0, distances, minimum, control, &found) }
    }
    return found.map { $0 != 0 }
  }
}
