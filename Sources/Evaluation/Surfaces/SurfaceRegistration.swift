import Foundation
import SceneModel

/// Aligns a surface or cloud with a reference surface, without cameras.
///
/// Iterative closest points (Besl and McKay, PAMI 1992) in both directions, so that neither a part
/// that only one of the surfaces has nor a shrinking scale is favored. The first estimate is the
/// best of rotations spread over all directions; the last steps minimize distances to the tangent
/// planes (Chen and Medioni, IVC 1992).
package struct SurfaceRegistration: Sendable {
  package struct Options: Codable, Hashable, Sendable {
    /// Whether the scale is estimated, too.
    package var estimatesScale = true
    /// Number of first rotations: 19° apart. Chosen.
    package var rotations = 576
    /// Samples of each surface, steps and kept candidates of each round, from coarse to fine.
    /// Chosen: the first round takes as long as the others.
    package var rounds = [
      Round(samples: 150, steps: 8, kept: 12), Round(samples: 1500, steps: 20, kept: 3),
      Round(samples: 20_000, steps: 50, kept: 1),
    ]
    /// Pairs farther apart than this multiple of the median are left out: the rim of a part that
    /// the other surface lacks. Chosen.
    package var outlierFactor: Float = 3
    /// A step that moves the surface by less than this share of its size is the last one. Chosen:
    /// below the rounding of positions in files.
    package var tolerance = 1e-7
    /// Number of threads; results are independent of it. Chosen.
    package var threadCount = 1

    package init() {}
  }

  package struct Round: Codable, Hashable, Sendable {
    package var samples: Int
    package var steps: Int
    package var kept: Int
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The similarity `referenceFromResult`, refined from `initial` if it is given. Throws
  /// `EvaluationError` if a surface is empty or has no extent.
  package func run(
    _ result: Mesh, _ reference: Mesh, from initial: SimilarityTransform? = nil
  ) throws -> SimilarityTransform {
    let tree = BoundingTree(result.triangles.map { FlatTriangle($0, of: result) })
    return try run(
      tree, samples: { SurfaceSampling().run(result, count: $0) }, reference, initial)
  }

  /// The same for a cloud.
  package func run(
    _ result: PointCloud, _ reference: Mesh, from initial: SimilarityTransform? = nil
  ) throws -> SimilarityTransform {
    func samples(_ count: Int) -> [SIMD3<Float>] {
      let step = max(1, result.count / max(1, count))
      return stride(from: 0, to: result.count, by: step).map { result.positions[$0] }
    }
    return try run(BoundingTree(result.positions), samples: samples, reference, initial)
  }

  private func run<Item>(
    _ tree: BoundingTree<Item>, samples: (Int) -> [SIMD3<Float>], _ reference: Mesh,
    _ initial: SimilarityTransform?
  ) throws -> SimilarityTransform {
    let most = options.rounds.map(\.samples).max() ?? 0
    let (from, to) = (
      Extent(samples(most)), Extent(SurfaceSampling().run(reference, count: most))
    )
    guard let from, let to else { throw EvaluationError.emptySurface }
    let referenceTree = BoundingTree(reference.triangles.map { FlatTriangle($0, of: reference) })
    let scale = options.estimatesScale ? to.radius / from.radius : 1
    var candidates =
      initial.map { [$0] }
      ?? Quaternion.spread(options.rotations).map {
        from.transform(to: to, rotation: $0, scale: scale)
      }
    for round in initial == nil ? options.rounds : options.rounds.suffix(1) {
      let pairing = Pairing(
        resultTree: tree, referenceTree: referenceTree, result: samples(round.samples),
        reference: SurfaceSampling().run(reference, count: round.samples),
        limit: Float(2 * to.radius))
      let isLast = round == options.rounds.last
      let refined = parallel(candidates) {
        refine($0, pairing, steps: round.steps, toPlanes: isLast, radius: to.radius)
      }
      let order = refined.indices.sorted { (refined[$0].cost, $0) < (refined[$1].cost, $1) }
      candidates = order.prefix(round.kept).map { refined[$0].transform }
    }
    return candidates[0]
  }

  private func parallel(
    _ candidates: [SimilarityTransform],
    _ body: @Sendable (SimilarityTransform) -> (transform: SimilarityTransform, cost: Float)
  ) -> [(transform: SimilarityTransform, cost: Float)] {
    parallelChunks(candidates.count, threads: options.threadCount, size: 1) { range in
      range.map { body(candidates[$0]) }
    }
  }

  /// The transform after several steps, and the median distance of the pairs.
  private func refine<Item>(
    _ initial: SimilarityTransform, _ pairing: Pairing<Item>, steps: Int, toPlanes: Bool,
    radius: Double
  ) -> (transform: SimilarityTransform, cost: Float) {
    var (best, transform) = (initial, initial)
    var cost = Float.infinity
    for _ in 0...steps {
      let pairs = pairing.pairs(transform)
      guard !pairs.isEmpty else { break }
      let median = pairs.map(\.distance).sorted()[pairs.count / 2]
      guard median < cost else { break }
      (best, cost) = (transform, median)
      let close = pairs.filter { $0.distance <= options.outlierFactor * median }
      let step = toPlanes ? planeStep(transform, close) : pointStep(close)
      guard let next = step else { break }
      // A few points determine how far the surface moves. Chosen.
      let moved = pairing.reference.prefix(8).map { point in
        (next * (transform.inverse * SIMD3<Double>(point)) - SIMD3<Double>(point)).length
      }
      transform = next
      if (moved.max() ?? 0) < options.tolerance * radius { break }
    }
    return (best, cost)
  }

  /// The transform with the least sum of squared distances of the pairs.
  private func pointStep(_ pairs: [ClosestPair]) -> SimilarityTransform? {
    let (source, target) = (pairs.map(\.source), pairs.map(\.target))
    guard var fit = SimilarityTransform.fitting(source, to: target, requiresUniqueRotation: true)
    else { return nil }
    guard !options.estimatesScale else { return fit }
    let count = Double(max(1, source.count))
    let center = source.reduce(.zero, +) / count
    fit.translation = target.reduce(.zero, +) / count - fit.rotation * center
    fit.scale = 1
    return fit
  }

  /// A Gauss–Newton step for the squared distances to the tangent planes of the reference.
  private func planeStep(
    _ transform: SimilarityTransform, _ pairs: [ClosestPair]
  ) -> SimilarityTransform? {
    let moved = pairs.map { transform * $0.source }
    let center = moved.reduce(.zero, +) / Double(max(1, moved.count))
    var equations = NormalEquations(unknowns: options.estimatesScale ? 7 : 6)
    for (pair, point) in zip(pairs, moved) {
      let (arm, normal) = (point - center, pair.normal)
      let turn = arm.cross(normal)
      equations.add(
        [turn.x, turn.y, turn.z, normal.x, normal.y, normal.z, normal.dot(arm)],
        normal.dot(pair.target - point))
    }
    guard let x = equations.solution else { return nil }
    let axis = SIMD3(x[0], x[1], x[2])
    let angle = axis.length
    let rotation =
      angle > 0 ? Quaternion(angle: angle, axis: axis / angle) : Quaternion.identity
    let scale = options.estimatesScale ? exp(x[6]) : 1
    let shift = SIMD3(x[3], x[4], x[5])
    return SimilarityTransform(
      scale: scale * transform.scale, rotation: (rotation * transform.rotation).normalized,
      translation: scale * (rotation * (transform.translation - center)) + center + shift)
  }
}

/// The centroid of samples, and their root mean square distance from it.
private struct Extent {
  var center: SIMD3<Double>
  var radius: Double

  init?(_ samples: [SIMD3<Float>]) {
    let points = samples.map { SIMD3<Double>($0) }
    let count = Double(max(1, points.count))
    let center = points.reduce(.zero, +) / count
    self.center = center
    radius = (points.reduce(0) { $0 + ($1 - center).squaredLength } / count).squareRoot()
    guard radius > 0, radius.isFinite else { return nil }
  }

  func transform(to other: Extent, rotation: Quaternion, scale: Double) -> SimilarityTransform {
    SimilarityTransform(
      scale: scale, rotation: rotation,
      translation: other.center - scale * (rotation * center))
  }
}
