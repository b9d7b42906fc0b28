import Foundation
import Kernels
import SceneModel
import Testing

@Suite struct SurfacePoissonTests {
  /// Points of a sphere (Fibonacci lattice) with their normals.
  private static func sphere(_ count: Int) -> [SIMD3<Float>] {
    (0..<count).map { index in
      let z = 1 - 2 * (Float(index) + 0.5) / Float(count)
      let (radius, angle) = ((1 - z * z).squareRoot(), 2.399_963 * Float(index))
      return [radius * cos(angle), radius * sin(angle), z]
    }
  }

  private static func surface(
    of points: [SIMD3<Float>], depth: Int, _ control: KernelControl
  ) throws -> PoissonReconstruction.Surface {
    var reconstruction = PoissonReconstruction()
    reconstruction.depth = depth
    return try reconstruction.surface(positions: points, normals: points, control)
  }

  @Test func pointsOfASphereGiveASphere() throws {
    let surface = try Self.surface(of: Self.sphere(2000), depth: 5, KernelControl())
    #expect(surface.mesh.triangles.count > 1000)
    #expect(surface.densities.count == surface.mesh.positions.count)
    #expect(surface.mesh.positions.allSatisfy { abs($0.length - 1) < 0.03 })
  }

  /// The solver of a canceled call goes on; the next ones must not add to its memory.
  @Test func laterCallsWaitForAnAbandonedSolver() throws {
    let canceled = CancellationFlag()
    #expect(throws: CancellationError.self) {
      try Self.surface(
        of: Self.sphere(20_000), depth: 7,
        KernelControl(flag: canceled) { if $0 > 0 { canceled.cancel() } })
    }
    // A call that waits can be canceled, too.
    let (flag, polls) = (CancellationFlag(), Locked(0))
    #expect(throws: CancellationError.self) {
      try Self.surface(
        of: Self.sphere(2000), depth: 5,
        KernelControl(flag: flag) { fraction in
          let count = polls.withLock { count in
            count += fraction == 0 ? 1 : 0
            return count
          }
          if count == 3 { flag.cancel() }
        })
    }
    #expect(try Self.numberOfPolls() > 1)
    // Nothing is left to wait for.
    #expect(try Self.numberOfPolls() == 1)
  }

  /// How often a call polls its control before it starts.
  private static func numberOfPolls() throws -> Int {
    let polls = Locked(0)
    let control = KernelControl { fraction in
      if fraction == 0 { polls.withLock { $0 += 1 } }
    }
    #expect(try !surface(of: sphere(2000), depth: 5, control).mesh.triangles.isEmpty)
    return polls.withLock { $0 }
  }
}
