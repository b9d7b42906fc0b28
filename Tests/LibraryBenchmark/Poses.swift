import ArgumentParser
import Foundation
import Kernels
import SceneModel

/// Problems of equal size in a file of numbers: how many, rows of each, then the rows.
private struct Problems {
  let count: Int
  let rows: Int
  private let values: [Double]
  private let columns: Int

  init(_ path: String, columns: Int) throws {
    values = try NumberFile.read(path)
    self.columns = columns
    (count, rows) = (Int(values[0]), Int(values[1]))
    guard values.count == 2 + count * rows * columns else {
      throw ValidationError("\(path) has \(values.count) numbers")
    }
  }

  /// Column `column` and the next one of each row.
  func pairs(_ problem: Int, _ column: Int) -> [SIMD2<Double>] {
    offsets(problem).map { [values[$0 + column], values[$0 + column + 1]] }
  }

  /// Column `column` and the next two of each row.
  func triples(_ problem: Int, _ column: Int) -> [SIMD3<Double>] {
    offsets(problem).map { SIMD3(values[($0 + column)..<($0 + column + 3)]) }
  }

  private func offsets(_ problem: Int) -> [Int] {
    (0..<rows).map { 2 + (problem * rows + $0) * columns }
  }
}

/// Solves five-point problems (rows x₁ y₁ x₂ y₂ at depth 1) or P3P problems (rows ray, point).
///
/// For each problem the output holds the number of solutions and their values: a matrix by rows, or
/// a quaternion x y z w and a translation. The printed time is the processor time per call in
/// microseconds, the minimum over `repetitions` passes over all problems.
struct MinimalSolvers: ParsableCommand {
  enum Solver: String, CaseIterable, ExpressibleByArgument {
    case fivePoint = "five-point"
    case p3p
  }

  static let configuration = CommandConfiguration(commandName: "solvers")

  @Argument var solver: Solver
  @Argument(help: "Problems.") var input: String
  @Argument(help: "Solutions.") var output: String
  @Option(help: "Passes over all problems.") var repetitions = 5

  func run() throws {
    var solutions: [[Double]] = []
    let microseconds: Double
    switch solver {
    case .fivePoint:
      let problems = try Problems(input, columns: 4)
      let samples = (0..<problems.count).map { (problems.pairs($0, 0), problems.pairs($0, 2)) }
      microseconds = try leastMicroseconds(samples) { first, second in
        try TwoViewEstimation.essentialMatrices(first, second)
      }
      solutions = try samples.map { first, second in
        try TwoViewEstimation.essentialMatrices(first, second).flatMap { m in
          [m.row0, m.row1, m.row2].flatMap { [$0.x, $0.y, $0.z] }
        }
      }
    case .p3p:
      let problems = try Problems(input, columns: 6)
      let samples = (0..<problems.count).map { (problems.triples($0, 0), problems.triples($0, 3)) }
      microseconds = try leastMicroseconds(samples) { rays, points in
        try Resection.perspectiveThreePoint(rays: rays, points: points)
      }
      solutions = try samples.map { rays, points in
        try Resection.perspectiveThreePoint(rays: rays, points: points).flatMap(\.numbers)
      }
    }
    let width = solver == .fivePoint ? 9 : 7
    try NumberFile.write(solutions.flatMap { [Double($0.count / width)] + $0 }, to: output)
    try printJSON(["microseconds": microseconds])
  }

  private func leastMicroseconds<A, B, Solution>(
    _ samples: [(A, B)], _ solve: (A, B) throws -> [Solution]
  ) throws -> Double {
    var least = Double.infinity
    for _ in 0..<repetitions {
      var found = 0
      let start = processorSeconds()
      for (a, b) in samples { found += try solve(a, b).count }
      least = min(least, (processorSeconds() - start) / Double(samples.count))
      guard found >= 0 else { break }
    }
    return 1e6 * least
  }
}

/// Estimates poses from correspondences with outliers: relative ones (rows x₁ y₁ x₂ y₂ at depth 1)
/// or absolute ones (rows u v, in pixels of a camera of focal length `focal` with the principal
/// point at 0, then X Y Z).
///
/// For each problem the output holds the processor seconds, the number of inliers (−1 without a
/// pose), a quaternion x y z w, a translation and the indices of the inliers.
struct RobustPoses: ParsableCommand {
  enum Kind: String, CaseIterable, ExpressibleByArgument { case relative, absolute }

  static let configuration = CommandConfiguration(commandName: "poses")

  @Argument var kind: Kind
  @Argument(help: "Problems.") var input: String
  @Argument(help: "Poses.") var output: String
  @Option(help: "Largest error of an inlier, in units of the points.") var limit: Double
  @Option(help: "Samples drawn at most.") var maximumIterations = 1000
  @Option(help: "Focal length in pixels, for absolute poses.") var focal = 1000.0

  func run() throws {
    let problems = try Problems(input, columns: kind == .relative ? 4 : 5)
    var numbers: [Double] = []
    for problem in 0..<problems.count {
      let (found, cost) = try Cost.measuring { try estimate(problems, problem) }
      numbers += [cost.cpuSeconds, Double(found?.inliers.count ?? -1)]
      numbers += (found?.pose ?? .identity).numbers
      numbers += (found?.inliers ?? []).map(Double.init)
    }
    try NumberFile.write(numbers, to: output)
  }

  private func estimate(
    _ problems: Problems, _ problem: Int
  ) throws -> (pose: RigidTransform, inliers: [Int])? {
    switch kind {
    case .relative:
      var estimation = TwoViewEstimation()
      (estimation.maximumError, estimation.maximumIterations) = (limit, maximumIterations)
      let found = try estimation.geometry(
        problems.pairs(problem, 0), problems.pairs(problem, 2), KernelControl())
      return found.map { ($0.secondFromFirst, $0.inliers) }
    case .absolute:
      var options = Resection.Options()
      (options.maximumError, options.maximumIterations) = (limit, maximumIterations)
      options.confidence = TwoViewEstimation().confidence
      let camera = Camera(
        width: 1, height: 1, focalLength: [focal, focal], principalPoint: .zero)
      do {
        let found = try Resection(options).run(
          pixels: problems.pairs(problem, 0), points: problems.triples(problem, 2), camera: camera)
        return (found.cameraFromWorld, found.isInlier.indices.filter { found.isInlier[$0] })
      } catch KernelError.degenerate {
        return nil
      }
    }
  }
}

extension RigidTransform {
  fileprivate var numbers: [Double] {
    [
      rotation.x, rotation.y, rotation.z, rotation.w, translation.x, translation.y, translation.z,
    ]
  }
}
