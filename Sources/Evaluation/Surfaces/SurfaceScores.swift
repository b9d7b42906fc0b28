import Foundation
import SceneModel

/// How close a surface or cloud is to the true one, in units of the reference.
package struct SurfaceScores: Codable, Hashable, Sendable {
  /// The scores at one distance; all from 0 to 1.
  package struct AtThreshold: Codable, Hashable, Sendable {
    package var threshold: Double
    /// The part of the result that is this close to the reference (accuracy).
    package var precision: Double
    /// The part of the reference that is this close to the result (completeness).
    package var recall: Double
    /// The harmonic mean of both.
    package var fScore: Double
  }

  /// Samples of the result and of the reference that were compared.
  package var resultSamples: Int
  package var referenceSamples: Int
  package var thresholds: [AtThreshold]
  /// Mean distance of the result from the reference, and the other way round; distances beyond
  /// `maximumDistance` count as that.
  package var accuracy: Double
  package var completeness: Double
  /// The mean of both.
  package var chamfer: Double
  package var maximumDistance: Double
}

/// Compares a mesh or cloud with a reference mesh (Knapitsch et al., Tanks and Temples, 2017).
package struct SurfaceComparison: Sendable {
  package struct Options: Codable, Hashable, Sendable {
    /// Distances of precision, recall and F-score, in units of the reference.
    package var thresholds = [0.0005, 0.001, 0.002]
    /// Longer distances count as this, in units of the reference.
    package var maximumDistance = 0.02
    /// Samples on the result.
    package var resultSamples = 1_000_000
    /// Samples on the reference.
    package var referenceSamples = 200_000
    /// Parts of the result farther than this outside the reference's box are ignored, in units of
    /// the reference: the table that an object stands on is no fault.
    package var margin = 0.01
    /// Parts of the result and of the reference below this are ignored: what a surface that stands
    /// on something looks like where it touches can't be seen.
    package var floor: Floor?
    /// Parts of the reference that fewer cameras see are ignored.
    package var minimumViews = 3
    /// Threads; results do not depend on it.
    package var threadCount = 1

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// What to compare results with. Cameras of the reference, when given, limit it to what they see.
  package func reference(
    _ mesh: Mesh, cameras: [NamedCamera] = []
  ) throws -> SurfaceReference {
    try SurfaceReference(mesh, cameras, options)
  }

  /// Scores `result` after `alignment` against `reference`.
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

  /// Scores the points of a cloud as they are, or their means in voxels with this side. A cloud
  /// that repeats what is easy to see looks better than it is until it is averaged.
  package func run(
    _ result: PointCloud, _ alignment: SimilarityTransform, reference: SurfaceReference,
    voxel: Double? = nil
  ) throws -> SurfaceScores {
    guard result.count > 0 else { throw EvaluationError.emptySurface }
    // What is farther away changes no distance.
    let reach = SIMD3<Float>(repeating: Float(max(options.margin, options.maximumDistance)))
    var points = transformed(result.positions, alignment).filter {
      reference.bounds.contains($0, margin: reach)
    }
    if let voxel { points = VoxelAveraging(side: voxel).run(points) }
    return try scores(points, BoundingTree(points), reference)
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
