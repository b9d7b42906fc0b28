import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Evaluation

@Suite struct SurfaceRegistrationTests {
  /// A bent, lopsided bar without symmetry.
  private static let shape: Mesh = {
    var mesh = SyntheticMesh.sphere(subdivisions: 4)
    mesh.positions = mesh.positions.map { p in
      let bend = 0.6 * p.x * p.x
      return [2 * p.x, 0.6 * p.y + bend, 0.4 * p.z + 0.3 * p.x * p.x * p.x + 0.2 * max(0, p.y)]
    }
    mesh.normals = []
    return mesh
  }()

  private static func moved(_ mesh: Mesh, _ transform: SimilarityTransform) -> Mesh {
    var mesh = mesh
    mesh.positions = mesh.positions.map { SIMD3<Float>(transform * SIMD3<Double>($0)) }
    return mesh
  }

  /// The largest distance of a vertex from where it should be.
  private static func error(
    _ found: SimilarityTransform, _ truth: SimilarityTransform
  ) -> Double {
    shape.positions.map { point in
      let moved = truth.inverse * SIMD3<Double>(point)
      return (found * moved - SIMD3<Double>(point)).length
    }.max() ?? 0
  }

  private static func transform(_ seed: UInt64, scale: Double) -> SimilarityTransform {
    var random = SplitMix64(seed: seed)
    func number() -> Double { .random(in: -1...1, using: &random) }
    let axis = SIMD3(number(), number(), number()).normalized
    return SimilarityTransform(
      scale: scale, rotation: Quaternion(angle: 3 * number(), axis: axis),
      translation: [5 * number(), 5 * number(), 5 * number()])
  }

  @Test(arguments: [1, 2, 3, 4] as [UInt64]) func anyOrientationIsFound(_ seed: UInt64) throws {
    let truth = Self.transform(seed, scale: 0.2 + Double(seed))
    let result = Self.moved(Self.shape, truth.inverse)
    let found = try SurfaceRegistration().run(result, Self.shape)
    #expect(Self.error(found, truth) < 1e-3)
    #expect(abs(found.scale / truth.scale - 1) < 1e-4)
  }

  @Test func aRigidAlignmentKeepsTheScale() throws {
    var options = SurfaceRegistration.Options()
    options.estimatesScale = false
    let truth = Self.transform(5, scale: 1)
    let found = try SurfaceRegistration(options).run(
      Self.moved(Self.shape, truth.inverse), Self.shape)
    #expect(found.scale == 1)
    #expect(Self.error(found, truth) < 1e-3)
  }

  /// A fifth of the surface is missing, and the noise is 1 % of the size.
  @Test func partsAndNoiseAreTolerated() throws {
    let truth = Self.transform(6, scale: 0.5)
    let part = SurfaceSampling().run(Self.shape, count: 30_000).filter { $0.x < 1.2 }
    var random = SplitMix64(seed: 8)
    let points = part.map { point -> SIMD3<Float> in
      let noise = SIMD3<Float>(
        .random(in: -0.02...0.02, using: &random), .random(in: -0.02...0.02, using: &random),
        .random(in: -0.02...0.02, using: &random))
      return SIMD3<Float>(truth.inverse * SIMD3<Double>(point + noise))
    }
    var cloud = PointCloud()
    cloud.positions = points
    let found = try SurfaceRegistration().run(cloud, Self.shape)
    #expect(Self.error(found, truth) < 0.03)
  }

  @Test func theResultIsIndependentOfThreads() throws {
    let result = Self.moved(Self.shape, Self.transform(7, scale: 2))
    var options = SurfaceRegistration.Options()
    let one = try SurfaceRegistration(options).run(result, Self.shape)
    options.threadCount = 3
    #expect(try SurfaceRegistration(options).run(result, Self.shape) == one)
  }

  @Test func emptySurfacesAreRefused() {
    #expect(throws: EvaluationError.emptySurface) {
      try SurfaceRegistration().run(Mesh(), Self.shape)
    }
    #expect(throws: EvaluationError.emptySurface) {
      try SurfaceRegistration().run(Self.shape, Mesh())
    }
  }

  @Test func rotationsCoverAllOrientations() {
    let rotations = Quaternion.spread(576)
    for seed in 0..<50 {
      let rotation = Self.transform(UInt64(100 + seed), scale: 1).rotation
      let nearest = rotations.map { ($0.conjugate * rotation).angle }.min() ?? .pi
      #expect(nearest < 0.5)
    }
  }
}
