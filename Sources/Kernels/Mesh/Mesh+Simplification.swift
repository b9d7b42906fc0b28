import CKernels
import SceneModel

extension Mesh {
  /// The mesh reduced to at most `maximumTriangles`: quadric edge collapse (Garland and Heckbert,
  /// SIGGRAPH 1997) that preserves the topology, boundaries and orientation of the surface; then a
  /// least-squares fit of its vertices to the original surface (after Hoppe et al., SIGGRAPH 1993).
  ///
  /// Duplicate and degenerate triangles are always dropped. Colors and normals are not carried
  /// over. If the topology prevents enough collapses, the smallest components are removed.
  package func simplified(
    maximumTriangles: Int, _ control: KernelControl
  ) throws -> Mesh {
    var result = Mesh(positions: positions, triangles: triangles)
    var (vertexCount, triangleCount) = (0, 0)
    try withKernel(control) { control in
      result.withMutableKernelValue { mesh in
        defer { (vertexCount, triangleCount) = (mesh.positions.count, mesh.triangle_count) }
        return ck_simplify(&mesh, max(0, maximumTriangles), control)
      }
    }
    result.positions.removeLast(result.positions.count - vertexCount)
    result.triangles.removeLast(result.triangles.count - triangleCount)
    return result
  }
}
