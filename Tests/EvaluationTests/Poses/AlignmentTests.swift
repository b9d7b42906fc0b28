import Foundation
import SceneModel
import Testing

@testable import Evaluation

@Suite struct AlignmentTests {
  static let truth = SimilarityTransform(
    scale: 2.5, rotation: Quaternion(angle: 2, axis: [1, -2, 0.5]), translation: [10, -3, 0.25])

  static func points(_ count: Int) -> [SIMD3<Double>] {
    var random = SplitMix64(seed: 7)
    return (0..<count).map { _ in
      [.random(in: -1...1, using: &random), .random(in: -1...1, using: &random), 0.3]
    }
  }

  /// The points are coplanar, so that a reflection would fit equally well.
  @Test(arguments: [3, 4, 50]) func exactPairsGiveTheExactTransform(_ count: Int) throws {
    let points = Self.points(count)
    let found = try #require(
      SimilarityAlignment().leastSquares(from: points, to: points.map { Self.truth * $0 }))
    #expect(abs(found.scale - 2.5) < 1e-9)
    #expect((found.rotation.conjugate * Self.truth.rotation).angle < 1e-7)
    #expect((found.translation - Self.truth.translation).length < 1e-8)
  }

  @Test func robustAlignmentIgnoresOutliers() throws {
    let points = Self.points(40)
    var target = points.map { Self.truth * $0 }
    for index in stride(from: 0, to: 40, by: 4) { target[index] += [3, Double(index), -5] }
    let found = try #require(SimilarityAlignment().robust(from: points, to: target))
    #expect(abs(found.scale - 2.5) < 1e-6)
    #expect((found.translation - Self.truth.translation).length < 1e-6)
  }

  @Test func degeneratePointsHaveNoAlignment() {
    let alignment = SimilarityAlignment()
    #expect(alignment.leastSquares(from: [], to: []) == nil)
    #expect(alignment.leastSquares(from: Self.points(2), to: Self.points(2)) == nil)
    let line = (0..<9).map { SIMD3(Double($0), 0, 0) }
    #expect(alignment.leastSquares(from: line, to: line) == nil)
    let same = [SIMD3<Double>](repeating: [1, 2, 3], count: 5)
    #expect(alignment.leastSquares(from: same, to: same) == nil)
    #expect(alignment.robust(from: line, to: line) == nil)
  }

  /// Cameras on a circle, facing its center.
  static func ring(_ count: Int) -> [NamedCamera] {
    (0..<count).map { index in
      let angle = 2 * Double.pi * Double(index) / Double(count)
      let rotation = Quaternion(angle: angle, axis: [0, 1, 0])
      return NamedCamera(
        name: "\(index).jpg", camera: Camera(width: 100, height: 100, focalLength: [100, 100]),
        cameraFromWorld: RigidTransform(rotation: rotation, translation: [0, 0.1, 2]))
    }
  }

  @Test func aMovedCopyHasNoErrors() throws {
    let reference = Self.ring(12)
    let moved = reference.map { camera in
      var camera = camera
      camera.cameraFromWorld = Self.truth.applied(toCameraFromA: camera.cameraFromWorld)
      return camera
    }
    let (errors, alignment) = try PoseErrors.comparing(moved.reversed(), with: reference)
    #expect(errors.registered == 12 && errors.total == 12)
    #expect(errors.centerMaximum < 1e-8)
    #expect(errors.rotationMaximumDegrees < 1e-4)
    #expect(errors.areaUnderCurve.allSatisfy { $0.value > 0.999 })
    #expect(abs(alignment.scale - 1 / 2.5) < 1e-9)
  }

  @Test func photosRotatedUprightHaveNoError() throws {
    let reference = Self.ring(9)
    let turn = RigidTransform(
      rotation: Quaternion(angle: .pi / 2, axis: [0, 0, 1]), translation: .zero)
    let turned = reference.map { camera in
      var camera = camera
      camera.cameraFromWorld = turn * camera.cameraFromWorld
      return camera
    }
    let (errors, _) = try PoseErrors.comparing(turned, with: reference)
    #expect(errors.rotationMaximumDegrees < 1e-4)
  }

  @Test func rotationAndCenterErrorsAreMeasured() throws {
    let reference = Self.ring(20)
    var result = reference
    let tilt = RigidTransform(
      rotation: Quaternion(angle: .pi / 180, axis: [1, 0, 0]), translation: .zero)
    result[3].cameraFromWorld = tilt * result[3].cameraFromWorld
    var center = result[8].cameraFromWorld
    center.translation += [0.5, 0, 0]
    result[8].cameraFromWorld = center
    let (errors, _) = try PoseErrors.comparing(result, with: reference)
    #expect(abs(errors.rotationMaximumDegrees - 1) < 1e-3)
    #expect(abs(errors.centerMaximum - 0.5) < 1e-6)
    #expect(abs(errors.centerRMSE - 0.5 / 20.0.squareRoot()) < 1e-6)
    #expect(errors.centerMedian < 1e-6)
  }

  @Test func missingPhotosLowerTheCurve() throws {
    let reference = Self.ring(10)
    let (errors, _) = try PoseErrors.comparing(Array(reference.prefix(5)), with: reference)
    #expect(errors.registered == 5 && errors.total == 10)
    let expected = Double(5 * 4) / Double(10 * 9)
    #expect(errors.areaUnderCurve.allSatisfy { abs($0.value - expected) < 1e-3 })
    #expect(throws: EvaluationError.noCommonPhotos) {
      try PoseErrors.comparing([], with: reference)
    }
    #expect(throws: EvaluationError.undeterminedAlignment(commonPhotos: 2)) {
      try PoseErrors.comparing(Array(reference.prefix(2)), with: reference)
    }
  }

  @Test func areaIsThatUnderTheSteps() {
    #expect(PoseErrors.area(under: [0, 0, 0, 0], to: 1) == 1)
    #expect(PoseErrors.area(under: [180, 180], to: 1) == 0)
    #expect(abs(PoseErrors.area(under: [0.5, 180], to: 1) - 0.375) < 1e-12)
    #expect(PoseErrors.area(under: [], to: 1) == 0)
  }

  @Test func referenceCamerasAreRead() throws {
    let json = """
      [{"name": "a.jpg", "K": [[100, 0, 50], [0, 110, 40], [0, 0, 1]],
        "R": [[1, 0, 0], [0, 0, -1], [0, 1, 0]], "t": [1, 2, 3], "other": 5},
       {"name": "b.jpg", "holdout": true, "K": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
        "R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "t": [0, 0, 0]}]
      """
    let cameras = try NamedCamera.cameras(json: Data(json.utf8))
    #expect(cameras.map(\.name) == ["a.jpg", "b.jpg"])
    #expect(cameras.map(\.isHeldOut) == [false, true])
    #expect(cameras[0].camera.focalLength == [100, 110])
    #expect(cameras[0].camera.width == 100 && cameras[0].camera.height == 80)
    let point = cameras[0].cameraFromWorld * SIMD3<Double>(0, 0, 1)
    #expect((point - SIMD3<Double>(1, 1, 3)).length < 1e-12)
    for bad in ["", "{}", #"[{"name": "a", "K": [], "R": [], "t": []}]"#] {
      #expect(throws: EvaluationError.self) { try NamedCamera.cameras(json: Data(bad.utf8)) }
    }
  }

  @Test(arguments: ["1e300", "-1e300", "7e17"]) func impossibleSizesAreErrors(center: String) {
    func json(_ size: String) -> Data {
      Data(
        """
        [{"name": "a.jpg", "K": [[100, 0, \(center)], [0, 100, 40], [0, 0, 1]],
          "R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "t": [0, 0, 0]\(size)}]
        """.utf8)
    }
    if center.hasPrefix("-") {
      #expect(throws: Never.self) { try NamedCamera.cameras(json: json("")) }
    } else {
      let error = #expect(throws: EvaluationError.self) {
        try NamedCamera.cameras(json: json(""))
      }
      #expect(error?.errorDescription?.contains("a.jpg can't have") == true)
    }
    #expect(throws: EvaluationError.self) {
      try NamedCamera.cameras(json: json(#", "width": 9000000000000000000, "height": 80"#))
    }
  }

  @Test func reprojectionErrorsAreMeasured() {
    let camera = Camera(width: 100, height: 100, focalLength: [100, 100])
    let photo = Photo(
      id: ID(0), sampleID: 0, name: "a", url: URL(fileURLWithPath: "/a"), width: 100, height: 100,
      orientation: 1, camera: ID(0))
    let observations = [3.0, 4.0].map {
      Observation(photo: ID(0), feature: 0, pixel: [50 + $0, 50])
    }
    let statistics = ReprojectionStatistics(
      Reconstruction(
        cameras: [camera], photos: [photo], poses: [.identity],
        points: [
          ScenePoint(position: [0, 0, 2], track: observations),
          ScenePoint(position: [0, 0, -2], track: observations),
        ]))
    #expect(statistics.observations == 2)
    #expect(abs(statistics.meanPixels - 3.5) < 1e-12)
    #expect(abs(statistics.rootMeanSquarePixels - 12.5.squareRoot()) < 1e-12)
    #expect(statistics.meanTrackLength == 2)
  }
}
