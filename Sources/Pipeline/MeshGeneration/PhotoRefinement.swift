import Kernels
import SceneModel

/// Photometric mesh refinement: moves the surface to where photos agree, at a finer resolution than
/// the dense stage's. Sharpens relief and edges, and reduces noise (after Vu et al., "High Accuracy
/// and Visibility-Consistent Dense Multiview Stereo", PAMI 2012).
package struct PhotoRefinement {
  package struct Options: Hashable, Codable, Sendable {
    /// Maximum number of pixels of a photo. Chosen.
    package var maximumPixels = 8_000_000
    package var surface = SurfaceRefinement.Options()

    package init() {}

    /// The options for a surface from views of `viewPixels` pixels.
    init(viewPixels: Int) { adapt(toViewPixels: viewPixels) }

    /// Pixels much smaller than those of the views add no information for triangles of that size.
    package mutating func adapt(toViewPixels viewPixels: Int) {
      maximumPixels = min(maximumPixels, 4 * max(1, viewPixels))
    }
  }

  var options = Options()

  /// `mesh` with refined positions and updated normals. Open boundaries stay unchanged, as does
  /// what fewer than two photos see or has no texture.
  func run(_ mesh: Mesh, source: ViewSource, _ context: StageContext) throws -> Mesh {
    let refinement = try SurfaceRefinement(
      mesh, options: options.surface, context.part(from: 0, to: 0.01).control)
    let views = source.reconstruction.registered
    let adding = context.part(from: 0.01, to: 0.15)
    for (index, photo) in views.enumerated() {
      try adding.step(index, of: views.count)
      try refinement.add(
        try source.view(photo, options.maximumPixels), adding.part(from: 0, to: 0).control)
    }
    var (result, moved) = try refinement.run(context.part(from: 0.15, to: 1).control)
    result.normals = result.areaWeightedNormals()
    context.notes.record("refinedVertices", Double(moved))
    return result
  }
}
