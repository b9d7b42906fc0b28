import SceneModel

/// A ground truth surface, preprocessed for comparison.
package struct SurfaceReference: Sendable {
  let bounds: Bounds
  let tree: BoundingTree<FlatTriangle>
  /// Sample points of the surface above the floor that enough cameras see.
  let samples: [SIMD3<Float>]

  init(_ mesh: Mesh, _ cameras: [NamedCamera], _ options: SurfaceComparison.Options) throws {
    guard let bounds = Bounds(mesh.positions), !mesh.triangles.isEmpty else {
      throw EvaluationError.emptySurface
    }
    self.bounds = bounds
    tree = BoundingTree(mesh.triangles.map { FlatTriangle($0, of: mesh) })
    var found = SurfaceSampling().samples(mesh, count: options.referenceSamples)
    if let floor = options.floor { found.removeAll { floor.isBelow($0.position) } }
    if !cameras.isEmpty {
      found = Visibility(
        cameras: cameras, tree: tree, minimumViews: options.minimumViews,
        maximumAngleDegrees: options.maximumViewAngleDegrees, threadCount: options.threadCount
      ).visible(found)
    }
    guard !found.isEmpty else { throw EvaluationError.emptySurface }
    samples = found.map(\.position)
  }
}
