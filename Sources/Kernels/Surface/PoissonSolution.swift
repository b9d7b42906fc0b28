import CKernels
import SceneModel

/// A solved function on an octree, whose surface of one value is the reconstructed surface.
///
/// A large scene is solved in parts that have the coarse levels in common: `refined` solves the
/// finer levels of a part, and `adopt` exchanges the values at seams, after which the surfaces of
/// adjoining boxes have the same vertices there.
package final class PoissonSolution {
  private let raw: OpaquePointer

  init(_ raw: OpaquePointer) { self.raw = raw }

  deinit { ck_poisson_free(raw) }

  /// Restores what the surface in a box depends on from the result of `encoded` for a box that
  /// contains it. Throws `KernelError.invalidArgument` if the bytes are malformed.
  package init(
    encoded bytes: UnsafeRawBufferPointer, for box: CellBox, _ control: KernelControl
  ) throws {
    var handle: OpaquePointer?
    try withKernel(control) { control in
      box.withKernelValue {
        ck_poisson_decode(bytes.baseAddress, bytes.count, $0, control, &handle)
      }
    }
    guard let handle else { throw KernelError.failed("no surface") }
    raw = handle
  }

  /// Greatest depth of the octree.
  package var depth: Int { Int(ck_poisson_depth(raw)) }

  /// The cube in which it is solved, in the frame of the points.
  package var cube: Cube {
    var origin = (0.0, 0.0, 0.0)
    var side = 0.0
    withUnsafeMutableBytes(of: &origin) {
      ck_poisson_cube(raw, $0.assumingMemoryBound(to: Double.self).baseAddress, &side)
    }
    return Cube(origin: [origin.0, origin.1, origin.2], side: side)
  }

  /// Solves the levels below, to `depth`, for the points of a part of the scene: all points there.
  package func refined(
    positions: [SIMD3<Float>], normals: [SIMD3<Float>], depth: Int, _ control: KernelControl
  ) throws -> PoissonSolution {
    guard positions.count == normals.count else {
      throw KernelError.invalidArgument("as many normals as positions are needed")
    }
    var handle: OpaquePointer?
    try withKernel(control) { control in
      withSpans(positions, normals) {
        ck_poisson_refine(raw, $0, $1, Int32(depth), control, &handle)
      }
    }
    guard let handle else { throw KernelError.failed("no surface") }
    return PoissonSolution(handle)
  }

  /// Takes the values of another part at the nodes in a box, below the levels of their common base.
  package func adopt(
    _ other: PoissonSolution, below baseDepth: Int, in box: CellBox, _ control: KernelControl
  ) throws {
    try withKernel(control) { control in
      box.withKernelValue { ck_poisson_adopt(raw, other.raw, Int32(baseDepth), $0, control) }
    }
  }

  /// The surface around the nodes in a box, or around all. It has positions and triangles only,
  /// counter-clockwise seen from the side that the normals point to, without cracks, and is open
  /// only where it leaves the box.
  package func surface(in box: CellBox? = nil, _ control: KernelControl) throws -> Mesh {
    var handle: OpaquePointer?
    try withKernel(control) { control in
      guard let box else { return ck_poisson_surface(raw, nil, control, &handle) }
      return box.withKernelValue { ck_poisson_surface(raw, $0, control, &handle) }
    }
    guard let handle else { throw KernelError.failed("no surface") }
    return SurfaceHandle(handle).mesh
  }

  /// Serializes what the surface in a box depends on.
  package func encoded(for box: CellBox) throws -> [UInt8] {
    var bytes: [UInt8] = []
    try withUnsafeMutablePointer(to: &bytes) { bytes in
      try withKernel(KernelControl()) { _ in
        box.withKernelValue {
          ck_poisson_encode(
            raw, $0,
            { context, start, count in
              context?.assumingMemoryBound(to: [UInt8].self).pointee
                .append(contentsOf: UnsafeRawBufferPointer(start: start, count: count))
            }, bytes)
        }
      }
    }
    return bytes
  }
}

/// Owns a mesh allocated by a kernel.
private final class SurfaceHandle {
  private let raw: OpaquePointer

  init(_ raw: OpaquePointer) { self.raw = raw }

  deinit { ck_surface_free(raw) }

  var mesh: Mesh {
    var mesh = Mesh(
      positions: Array(repeating: .zero, count: ck_surface_vertex_count(raw)),
      triangles: Array(
        repeating: Triangle(0, 0, 0), count: ck_surface_triangle_count(raw)))
    mesh.withMutableKernelValue { ck_surface_copy(raw, $0.positions, $0.triangles) }
    return mesh
  }
}
