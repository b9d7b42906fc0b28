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
    guard positions.count == normals.count else {
      throw KernelError.invalidArgument("as many normals as positions are needed")
    }
    var options = ck_poisson_options(
      depth: Int32(depth), scale: scale, maximum_bytes: max(0, maximumBytes))
    var handle: OpaquePointer?
    try withKernel(control) { control in
      withSpans(positions, normals) { ck_poisson($0, $1, &options, control, &handle) }
    }
    guard let handle else { throw KernelError.failed("no surface") }
    let surface = SurfaceHandle(handle)
    return (surface.mesh, surface.depth)
  }
}

/// Owns a mesh allocated by a kernel.
private final class SurfaceHandle {
  private let raw: OpaquePointer

  init(_ raw: OpaquePointer) { self.raw = raw }

  deinit { ck_surface_free(raw) }

  var depth: Int { Int(ck_surface_depth(raw)) }

  var mesh: Mesh {
    var mesh = Mesh(
      positions: Array(repeating: .zero, count: ck_surface_vertex_count(raw)),
      triangles: Array(
        repeating: Triangle(0, 0, 0), count: ck_surface_triangle_count(raw)))
    mesh.withMutableKernelValue { ck_surface_copy(raw, $0.positions, $0.triangles) }
    return mesh
  }
}
