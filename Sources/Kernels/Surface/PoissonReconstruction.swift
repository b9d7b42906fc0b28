import CKernels
import SceneModel

/// Screened Poisson surface reconstruction (Kazhdan and Hoppe, ACM TOG 2013).
package struct PoissonReconstruction: Hashable, Codable, Sendable {
  /// Octree depth: the smallest cells have a side of `scale × extent / 2^depth`. Chosen.
  package var depth = 9
  /// Side of the cube in which the system is solved, relative to the largest extent of the points.
  /// Chosen: the default of the code of Kazhdan and Hoppe 2013.
  package var scale = 1.1
  /// Memory that the solver may use, in bytes; the octree is less deep if it would need more.
  package var maximumBytes = Int.max

  package init() {}

  /// Reconstructs the surface of oriented points; points that are not finite or have no normal are
  /// ignored.
  ///
  /// The mesh has positions and triangles only, counter-clockwise seen from the side that the
  /// normals point to. It has no cracks, and is open only where it leaves the cube. The depth
  /// is less than `depth` if memory does not suffice.
  package func surface(
    positions: [SIMD3<Float>], normals: [SIMD3<Float>], _ control: KernelControl
  ) throws -> (mesh: Mesh, depth: Int) {
    // Measured: the shares of the time on boot and orbit.
    let solution = try solve(
      positions: positions, normals: normals, control.part(from: 0, to: 0.75))
    return (try solution.surface(control.part(from: 0.75, to: 1)), solution.depth)
  }

  /// Solves the system of oriented points, in `cube` if it is given: then points outside are
  /// ignored.
  package func solve(
    positions: [SIMD3<Float>], normals: [SIMD3<Float>], in cube: Cube? = nil,
    _ control: KernelControl
  ) throws -> PoissonSolution {
    guard positions.count == normals.count else {
      throw KernelError.invalidArgument("as many normals as positions are needed")
    }
    let origin = cube?.origin ?? .zero
    var options = ck_poisson_options(
      depth: Int32(depth), scale: scale, maximum_bytes: max(0, maximumBytes),
      cube_origin: (origin.x, origin.y, origin.z), cube_side: cube?.side ?? 0)
    var handle: OpaquePointer?
    try withKernel(control) { control in
      withSpans(positions, normals) { ck_poisson_solve($0, $1, &options, control, &handle) }
    }
    guard let handle else { throw KernelError.failed("no surface") }
    return PoissonSolution(handle)
  }
}
