import Foundation
import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct EvidenceSurveyTests {
  /// A triangle at the origin that faces +z.
  private let mesh = Mesh(
    positions: [[-0.01, -0.01, 0], [0.02, -0.01, 0], [-0.01, 0.02, 0]],
    triangles: [Triangle(0, 1, 2)])

  /// Photos with a focal length of 1000 pixels at these places.
  private func reconstruction(_ centers: [SIMD3<Double>]) -> Reconstruction {
    let camera = Camera(width: 100, height: 100, focalLength: [1000, 1000])
    return Reconstruction(
      cameras: [camera],
      photos: centers.indices.map {
        Photo(
          id: ID($0), sampleID: $0, name: "\($0)", url: URL(fileURLWithPath: "/"), width: 100,
          height: 100, orientation: 1, camera: ID(0))
      },
      poses: centers.map { RigidTransform(rotation: .identity, translation: -$0) }, points: [])
  }

  private func face(
    _ centers: [SIMD3<Double>], colors: [SIMD3<Float>]? = nil
  ) throws -> ModelEvidence.Face {
    let gains = [ExposureGain](repeating: .none, count: centers.count)
    let seen = try FaceViews(
      faceCount: 1,
      observationsByView: centers.indices.map {
        [
          FaceObservation(
            face: 0, area: 9, cosine: 1, gradient: 0,
            color: colors?[$0] ?? SIMD3(repeating: 50))
        ]
      })
    return try #require(
      try EvidenceSurvey(reconstruction(centers), gains: gains)
        .run(mesh, seen: seen, KernelControl()).first)
  }

  /// Two rays at ±θ/2 of the normal, each exact to σ = r / f across itself, meet with a standard
  /// deviation of σ / (√2 · sin θ/2) along the normal.
  @Test(arguments: [5.0, 20, 60, 120])
  func twoRaysHaveTheKnownPrecision(angle: Double) throws {
    let half = angle / 2 * .pi / 180
    let centers = [1.0, -1.0].map { SIMD3(2 * sin(half) * $0, 0, 2 * cos(half)) }
    let face = try face(centers)
    let expected = 2 / 1000 / (2.0.squareRoot() * sin(half))
    #expect(face.photoCount == 2)
    #expect(abs(Double(face.uncertainty) / expected - 1) < 0.001)
  }

  @Test func onePhotoOrParallelRaysDetermineNothing() throws {
    #expect(try face([[0, 0, 2]]).uncertainty.isNaN)
    #expect(try face([[0, 0, 2], [0, 0, 3]]).uncertainty.isNaN)
  }

  @Test func morePhotosAreMorePrecise() throws {
    let two = try face([[0.5, 0, 2], [-0.5, 0, 2]])
    let four = try face([[0.5, 0, 2], [-0.5, 0, 2], [0.5, 0, 2], [-0.5, 0, 2]])
    #expect(abs(four.uncertainty / two.uncertainty - Float(0.5).squareRoot()) < 0.001)
  }

  @Test func colorsDifferByTheirDeviation() throws {
    let face = try face(
      [[0.5, 0, 2], [-0.5, 0, 2]], colors: [[90, 100, 100], [110, 100, 100]])
    #expect(abs(face.photometricResidual - Float(100.0 / 3).squareRoot()) < 0.01)
    #expect(try self.face([[0, 0, 2]]).photometricResidual.isNaN)
  }
}
