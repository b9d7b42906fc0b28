import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct TwoViewGeometryTests {
  /// Two views of random points, 4…8 units in front of the first camera.
  struct World {
    var secondFromFirst: RigidTransform
    var first: [SIMD2<Double>] = []
    var second: [SIMD2<Double>] = []

    init(
      _ count: Int, seed: UInt64, noise: Double = 0, isPlanar: Bool = false, baseline: Double = 1
    ) {
      var random = SeededGenerator(seed: seed)
      let rotation = Quaternion(angle: 0.1 + 0.4 * random.uniform(), axis: random.normal3())
      secondFromFirst = RigidTransform(
        rotation: rotation, translation: random.normal3().normalized * baseline)
      while first.count < count {
        var point = SIMD3(
          4 * random.uniform() - 2, 4 * random.uniform() - 2, 4 + 4 * random.uniform())
        if isPlanar { point.z = 6 + 0.3 * point.x - 0.2 * point.y }
        let moved = secondFromFirst * point
        guard moved.z > 0.5 else { continue }
        first.append(SIMD2(point.x, point.y) / point.z + Self.error(noise, &random))
        second.append(SIMD2(moved.x, moved.y) / moved.z + Self.error(noise, &random))
      }
    }

    static func error(_ noise: Double, _ random: inout SeededGenerator) -> SIMD2<Double> {
      let (x, y) = (random.normal(), random.normal())
      return noise * SIMD2(x, y)
    }

    /// [t]× R of norm 1.
    var essential: Matrix3 {
      let t = secondFromFirst.translation
      let cross = Matrix3(rows: [0, -t.z, t.y], [t.z, 0, -t.x], [-t.y, t.x, 0])
      let e = cross * secondFromFirst.rotation.matrix
      let norm = e.elements.reduce(0) { $0 + $1 * $1 }.squareRoot()
      return Matrix3(rows: e.row0 / norm, e.row1 / norm, e.row2 / norm)
    }

    /// Replaces the first part of the matches with random ones, of similar quality to the others.
    mutating func spoil(_ share: Double, seed: UInt64) {
      var random = SeededGenerator(seed: seed)
      let order = first.indices.map { ($0, random.next()) }.sorted { $0.1 < $1.1 }.map(\.0)
      for index in order.prefix(Int(share * Double(first.count))) {
        second[index] = [random.uniform() - 0.5, random.uniform() - 0.5]
      }
    }

    /// Errors in radians of the rotation and of the translation direction.
    func errors(of pose: RigidTransform) -> (rotation: Double, translation: Double) {
      let direction = secondFromFirst.translation.normalized
      let other = pose.translation.normalized
      return (
        (pose.rotation * secondFromFirst.rotation.conjugate).angle,
        atan2(direction.cross(other).length, direction.dot(other))
      )
    }
  }

  static func distance(_ a: Matrix3, _ b: Matrix3) -> Double {
    func norm(_ sign: Double) -> Double {
      zip(a.elements, b.elements).reduce(0) {
        let d = $1.0 - sign * $1.1
        return $0 + d * d
      }.squareRoot()
    }
    return min(norm(1), norm(-1))
  }

  @Test func fivePointSolverFindsTheTrueMatrix() throws {
    var errors: [Double] = []
    for seed in 0..<300 {
      let world = World(5, seed: UInt64(seed))
      let solutions = try TwoViewEstimation.essentialMatrices(world.first, world.second)
      #expect(solutions.count <= 10)
      errors.append(solutions.map { Self.distance($0, world.essential) }.min() ?? .infinity)
      for e in solutions {
        #expect(abs(e.determinant) < 1e-5)
        for (a, b) in zip(world.first, world.second) {
          #expect(abs(SIMD3(b, 1).dot(e * SIMD3(a, 1))) < 1e-9)
        }
      }
    }
    // Some samples are nearly degenerate and lose precision.
    errors.sort()
    #expect(errors[150] < 1e-11 && errors[290] < 1e-6 && errors[299] < 1e-3)
  }

  @Test(arguments: 0..<100)
  func sevenPointSolverFindsTheTrueMatrix(seed: Int) throws {
    let world = World(7, seed: UInt64(seed) + 1000)
    let solutions = try TwoViewEstimation.fundamentalMatrices(world.first, world.second)
    #expect((1...3).contains(solutions.count))
    #expect(solutions.contains { Self.distance($0, world.essential) < 1e-6 })
    #expect(solutions.allSatisfy { abs($0.determinant) < 1e-9 })
  }

  @Test(arguments: [true, false], [0.0, 0.3, 0.5])
  func outlierMatchesAreDetected(isCalibrated: Bool, share: Double) throws {
    var world = World(400, seed: 11, noise: 2e-4)
    world.spoil(share, seed: 12)
    var estimation = TwoViewEstimation()
    estimation.isCalibrated = isCalibrated
    let geometry = try #require(
      try estimation.geometry(world.first, world.second, KernelControl()))
    let errors = world.errors(of: geometry.secondFromFirst)
    #expect(errors.rotation < (isCalibrated ? 1e-3 : 5e-3))
    #expect(errors.translation < (isCalibrated ? 3e-3 : 2e-2))
    let right = 400 - Int(share * 400)
    #expect(geometry.inliers.count >= right * 98 / 100)
    #expect(geometry.inliers.count <= right + 400 / 20)
    #expect(geometry.homographyInlierCount < right / 2)
  }

  @Test func refinementReachesTheNoiseLevel() throws {
    let world = World(1000, seed: 21, noise: 2e-4)
    let geometry = try #require(
      try TwoViewEstimation().geometry(world.first, world.second, KernelControl()))
    let errors = world.errors(of: geometry.secondFromFirst)
    #expect(errors.rotation < 2e-4 && errors.translation < 4e-4)
    #expect(geometry.medianAngle > 0.05)
  }

  @Test func planesAreDetected() throws {
    let world = World(300, seed: 31, noise: 1e-4, isPlanar: true)
    let geometry = try #require(
      try TwoViewEstimation().geometry(world.first, world.second, KernelControl()))
    #expect(geometry.homographyInlierCount > 290)
  }

  @Test func pureRotationsHaveZeroAngle() throws {
    let world = World(300, seed: 32, noise: 1e-5, baseline: 0)
    let geometry = try #require(
      try TwoViewEstimation().geometry(world.first, world.second, KernelControl()))
    #expect(geometry.homographyInlierCount > 290)
    #expect(geometry.medianAngle < 1e-3)
  }

  @Test(arguments: [true, false])
  func degenerateMatchesAreHandled(isCalibrated: Bool) throws {
    var estimation = TwoViewEstimation()
    estimation.isCalibrated = isCalibrated
    let control = KernelControl()
    let line = (0..<40).map { SIMD2(Double($0) / 40, 0.25) }
    let point = [SIMD2<Double>](repeating: [0.1, 0.2], count: 40)
    for points in [line, point, [], Array(line.prefix(4))] {
      let geometry = try estimation.geometry(points, points, control)
      #expect(geometry.map { $0.matrix.elements.allSatisfy(\.isFinite) } ?? true)
      #expect(geometry.map { $0.medianAngle.isFinite } ?? true)
    }
    #expect(throws: KernelError.self) {
      _ = try estimation.geometry([[.nan, 0]], [[0, 0]], control)
    }
    #expect(throws: KernelError.self) { _ = try estimation.geometry(line, [], control) }
  }

  @Test func seedsDetermineTheResult() throws {
    var world = World(200, seed: 41, noise: 3e-4)
    world.spoil(0.5, seed: 42)
    var estimation = TwoViewEstimation()
    estimation.seed = 5
    let a = try #require(try estimation.geometry(world.first, world.second, KernelControl()))
    let b = try #require(try estimation.geometry(world.first, world.second, KernelControl()))
    #expect(a.matrix == b.matrix && a.inliers == b.inliers && a.iterations == b.iterations)
  }

  @Test func canceledEstimationThrows() throws {
    let flag = CancellationFlag()
    flag.cancel()
    let world = World(100, seed: 51)
    #expect(throws: CancellationError.self) {
      _ = try TwoViewEstimation().geometry(world.first, world.second, KernelControl(flag: flag))
    }
  }
}
