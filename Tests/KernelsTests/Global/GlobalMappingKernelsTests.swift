import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct RotationAveragingTests {
  private func random(_ random: inout SeededGenerator, upTo angle: Double) -> Quaternion {
    Quaternion(angle: angle * random.uniform(), axis: random.normal3())
  }

  /// Pairs of 40 photos: neighbors and random others; `isWrong` marks the random outliers.
  private func pairs(
    _ truth: [Quaternion], wrongShare: Double, noise: Double, _ generator: inout SeededGenerator
  ) -> (pairs: [RelativeRotation], isWrong: [Bool]) {
    var pairs: [RelativeRotation] = []
    var isWrong: [Bool] = []
    for first in truth.indices {
      for second in truth.indices where second > first {
        guard second == first + 1 || generator.uniform() < 0.3 else { continue }
        isWrong.append(second != first + 1 && generator.uniform() < wrongShare)
        let relative = truth[second] * truth[first].conjugate
        let error =
          isWrong[pairs.count]
          ? Quaternion(angle: 0.5 + 2 * generator.uniform(), axis: generator.normal3())
          : Quaternion(angle: noise * generator.normal(), axis: generator.normal3())
        pairs.append(
          RelativeRotation(
            first: Int32(first), second: Int32(second), rotation: (error * relative).normalized))
      }
    }
    return (pairs, isWrong)
  }

  private func largestError(_ found: [Quaternion], _ truth: [Quaternion]) -> Double {
    let shift = truth[0].conjugate * found[0]
    return zip(found, truth).map { ($0 * ($1 * shift).conjugate).angle }.max() ?? .infinity
  }

  @Test(arguments: [0, 0.1, 0.25]) func outlierPairsAreRejected(wrongShare: Double) throws {
    var generator = SeededGenerator(seed: 5)
    let truth = (0..<40).map { _ in random(&generator, upTo: .pi) }
    let (pairs, isWrong) = pairs(
      truth, wrongShare: wrongShare, noise: 0.001, &generator)
    #expect(isWrong.contains(true) == (wrongShare > 0))
    // A bad initialization: every rotation is off by up to 40 degrees.
    let start = truth.map { (random(&generator, upTo: 0.7) * $0).normalized }
    let result = try RotationAveraging().run(pairs, start: start)
    #expect(largestError(result.rotations, truth) < 0.1 * .pi / 180)
    for (error, isWrong) in zip(result.errors, isWrong) { #expect((error > 0.1) == isWrong) }
  }

  @Test func exactPairsGiveExactRotations() throws {
    var generator = SeededGenerator(seed: 6)
    let truth = (0..<20).map { _ in random(&generator, upTo: .pi) }
    let (pairs, _) = pairs(truth, wrongShare: 0, noise: 0, &generator)
    let start = truth.map { (random(&generator, upTo: 0.5) * $0).normalized }
    let result = try RotationAveraging().run(pairs, start: start)
    #expect(result.rotations[0] == start[0].normalized)
    #expect(largestError(result.rotations, truth) < 1e-6)
  }

  @Test func invalidInputIsAnError() {
    let start = [Quaternion](repeating: .identity, count: 4)
    let pair = RelativeRotation(first: 0, second: 1, rotation: .identity)
    let stray = RelativeRotation(first: 1, second: 9, rotation: .identity)
    #expect(throws: KernelError.self) { try RotationAveraging().run([], start: start) }
    #expect(throws: KernelError.self) { try RotationAveraging().run([pair, stray], start: start) }
    #expect(throws: KernelError.self) { try RotationAveraging().run([pair], start: start) }
  }
}

@Suite struct GlobalPositioningTests {
  /// The true directions of a scene's points; a share of them is random.
  private func directions(_ scene: SyntheticScene, wrongShare: Double) -> [PointDirection] {
    var random = SeededGenerator(seed: 3)
    return scene.reconstruction.points.enumerated().flatMap { index, point in
      point.track.map { observation in
        let photo = observation.photo.index
        let direction =
          random.uniform() < wrongShare
          ? random.normal3() : point.position - scene.poses[photo].center
        return PointDirection(
          photo: Int32(photo), point: Int32(index), direction: direction.normalized)
      }
    }
  }

  private func positioned(
    _ scene: SyntheticScene, _ directions: [PointDirection], seed: UInt64
  ) throws -> PoseComparison {
    var random = SeededGenerator(seed: seed)
    let points = scene.reconstruction.points.map { _ in 30 * random.normal3() }
    let result = try GlobalPositioning().run(
      directions, centers: scene.poses.map { _ in 30 * random.normal3() }, points: points)
    #expect(result.finalCost <= result.initialCost)
    let poses = zip(scene.poses, result.centers).map { pose, center in
      RigidTransform(rotation: pose.rotation, translation: -(pose.rotation * center))
    }
    return PoseComparison(estimated: poses, true: scene.poses)
  }

  @Test(arguments: SyntheticScene.Layout.allCases, [1, 2, 3] as [UInt64])
  func exactDirectionsGiveExactCenters(layout: SyntheticScene.Layout, seed: UInt64) throws {
    var options = SyntheticScene.Options()
    options.layout = layout
    options.pointCount = 300
    let scene = SyntheticScene(options)
    let poses = try positioned(scene, directions(scene, wrongShare: 0), seed: seed)
    #expect(poses.maximumCenterError < 1e-3)
  }

  @Test func outlierDirectionsHaveLittleEffect() throws {
    var options = SyntheticScene.Options()
    options.pointCount = 400
    options.photoCount = 20
    let scene = SyntheticScene(options)
    let poses = try positioned(scene, directions(scene, wrongShare: 0.1), seed: 1)
    #expect(poses.maximumCenterError < 0.05)
  }

  /// So many photos that the system of equations is factorized by fronts.
  @Test func manyCentersDoNotDependOnThreads() throws {
    var options = SyntheticScene.Options()
    options.pointCount = 600
    options.photoCount = 130
    let scene = SyntheticScene(options)
    let directions = directions(scene, wrongShare: 0.05)
    var random = SeededGenerator(seed: 5)
    let points = scene.reconstruction.points.map { _ in 30 * random.normal3() }
    let centers = scene.poses.map { _ in 30 * random.normal3() }
    let results = try [1, 3].map { threads in
      try GlobalPositioning().run(
        directions, centers: centers, points: points,
        control: KernelControl(threadCount: threads))
    }
    #expect(results[0].centers == results[1].centers)
    #expect(results[0].points == results[1].points)
    let poses = zip(scene.poses, results[0].centers).map { pose, center in
      RigidTransform(rotation: pose.rotation, translation: -(pose.rotation * center))
    }
    #expect(
      PoseComparison(estimated: poses, true: scene.poses).maximumCenterError < 0.05)
  }

  @Test func invalidInputIsAnError() {
    let places = [SIMD3<Double>](repeating: .zero, count: 2)
    let stray = PointDirection(photo: 5, point: 0, direction: [0, 0, 1])
    #expect(throws: KernelError.self) {
      try GlobalPositioning().run([], centers: places, points: places)
    }
    #expect(throws: KernelError.self) {
      try GlobalPositioning().run([stray], centers: places, points: places)
    }
  }
}
