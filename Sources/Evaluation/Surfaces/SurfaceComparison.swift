import Foundation
import SceneModel

/// Compares a mesh or cloud with a reference mesh (Knapitsch et al., Tanks and Temples, 2017).
package struct SurfaceComparison: Sendable {
  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Prepares a reference. Its cameras, if given, limit it to the visible parts.
  package func reference(
    _ mesh: Mesh, cameras: [NamedCamera] = []
  ) throws -> SurfaceReference {
    try SurfaceReference(mesh, cameras, options)
  }

  /// Scores the mesh `result`, transformed by `alignment`, against `reference`. Throws
  /// `EvaluationError.emptySurface`.
  package func run(
    _ result: Mesh, _ alignment: SimilarityTransform, reference: SurfaceReference
  ) throws -> SurfaceScores {
    var aligned = result
    aligned.positions = transformed(result.positions, alignment)
    let tree = BoundingTree(aligned.triangles.map { FlatTriangle($0, of: aligned) })
    let samples = SurfaceSampling().run(aligned, count: options.resultSamples)
    guard !samples.isEmpty else { throw EvaluationError.emptySurface }
    return try scores(samples, tree, reference)
  }

  /// Scores the points of a cloud directly, or after downsampling with the given voxel size.
  /// Without it, a cloud with many points on easily visible parts scores too well.
  package func run(
    _ result: PointCloud, _ alignment: SimilarityTransform, reference: SurfaceReference,
    voxel: Double? = nil
  ) throws -> SurfaceScores {
    guard result.count > 0 else { throw EvaluationError.emptySurface }
    // Points that are farther away don't affect any distance.
    let reach = SIMD3<Float>(repeating: Float(max(options.margin, options.maximumDistance)))
    var points = transformed(result.positions, alignment).filter {
      reference.bounds.contains($0, margin: reach)
    }
    if let voxel { points = VoxelAveraging(side: voxel).run(points) }
    return try scores(points, BoundingTree(points), reference)
  }

  /// The distance of each vertex of `result`, transformed by `alignment`, to the surface
  /// `reference`, at most `maximumDistance`; in units of the reference.
  package func distances(
    of result: Mesh, _ alignment: SimilarityTransform, to reference: Mesh
  ) -> [Float] {
    let tree = BoundingTree(reference.triangles.map { FlatTriangle($0, of: reference) })
    return distances(transformed(result.positions, alignment), tree)
  }

  private func transformed(
    _ points: [SIMD3<Float>], _ transform: SimilarityTransform
  ) -> [SIMD3<Float>] {
    points.map { SIMD3<Float>(transform * SIMD3<Double>($0)) }
  }

  private func scores<Item>(
    _ samples: [SIMD3<Float>], _ resultTree: BoundingTree<Item>, _ reference: SurfaceReference
  ) throws -> SurfaceScores {
    let margin = SIMD3<Float>(repeating: Float(options.margin))
    let inside = samples.filter {
      reference.bounds.contains($0, margin: margin) && options.floor?.isBelow($0) != true
    }
    let toReference = distances(inside, reference.tree)
    let toResult = distances(reference.samples, resultTree)
    func mean(_ values: [Float]) -> Double {
      values.isEmpty
        ? options.maximumDistance
        : values.reduce(0.0) { $0 + Double($1) } / Double(values.count)
    }
    let (accuracy, completeness) = (mean(toReference), mean(toResult))
    return SurfaceScores(
      resultSamples: inside.count, referenceSamples: reference.samples.count,
      thresholds: options.thresholds.map { Self.scores(toReference, toResult, $0) },
      accuracy: accuracy, completeness: completeness, chamfer: (accuracy + completeness) / 2,
      maximumDistance: options.maximumDistance)
  }

  private static func scores(
    _ toReference: [Float], _ toResult: [Float], _ threshold: Double
  ) -> SurfaceScores.AtThreshold {
    func fraction(_ distances: [Float]) -> Double {
      let close = distances.reduce(0) { $0 + (Double($1) < threshold ? 1 : 0) }
      return Double(close) / Double(max(1, distances.count))
    }
    let (precision, recall) = (fraction(toReference), fraction(toResult))
    let sum = precision + recall
    return .init(
      threshold: threshold, precision: precision, recall: recall,
      fScore: sum > 0 ? 2 * precision * recall / sum : 0)
  }

  private func distances<Item>(
    _ points: [SIMD3<Float>], _ tree: BoundingTree<Item>
  ) -> [Float] {
    let limit = Float(options.maximumDistance)
    return parallelChunks(points.count, threads: options.threadCount) { range in
      var stack = BoundingTree<Item>.Stack()
      return range.map { tree.distance(to: points[$0], limit: limit, &stack) }
    }
  }
}
