import Kernels
import SceneModel

/// Reduces a surface to the triangle budget of a detail level before texturing: quadric edge
/// collapse (Garland and Heckbert, SIGGRAPH 1997), then a least-squares fit of the vertices to the
/// original surface (after Hoppe et al., "Mesh optimization", SIGGRAPH 1993).
package struct Simplification: Sendable {
  /// Parameters of simplification.
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum number of triangles. Chosen: that of the medium level (`DetailSpecification`).
    package var maximumTriangles = 99_999

    package init(maximumTriangles: Int = 99_999) { self.maximumTriangles = maximumTriangles }
  }

  package var options: Options

  package init(options: Options = Options()) { self.options = options }

  /// The surface with at most `maximumTriangles` triangles and new unit vertex normals.
  ///
  /// Contains no duplicate or degenerate triangles, and no unused vertices. Throws
  /// `PipelineError.noSurface` for an empty mesh.
  package func run(_ mesh: Mesh, _ context: StageContext) throws -> Mesh {
    try context.control.step(0)
    guard !mesh.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "the surface has no triangles")
    }
    var result = try mesh.simplified(
      maximumTriangles: options.maximumTriangles, context.control)
    result.normals = result.angleWeightedNormals()
    context.notes.record("triangles", Double(result.triangles.count))
    context.notes.record("trianglesBeforeSimplification", Double(mesh.triangles.count))
    return result
  }
}
