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
    var (vertexCount, triangleCount) = (positions.count, triangles.count)
    try withKernel(control) { control in
      result.positions.withUnsafeMutableBytes { positions in
        result.triangles.withUnsafeMutableBytes { triangles in
          ck_simplify(
            positions.baseAddress?.assumingMemoryBound(to: Float.self), &vertexCount,
            MemoryLayout<SIMD3<Float>>.stride,
            triangles.baseAddress?.assumingMemoryBound(to: UInt32.self), &triangleCount,
            max(0, maximumTriangles), control)
        }
      }
    }
    result.positions.removeLast(result.positions.count - vertexCount)
    result.triangles.removeLast(result.triangles.count - triangleCount)
    return result
  }
}
