import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct SurfacePoissonTests {
  private struct Points {
    var positions: [SIMD3<Float>] = []
    var normals: [SIMD3<Float>] = []

    func surface(depth: Int, _ control: KernelControl = KernelControl()) throws -> Mesh {
      var reconstruction = PoissonReconstruction()
      reconstruction.depth = depth
      return try reconstruction.surface(positions: positions, normals: normals, control).mesh
    }

    func moved(by offset: SIMD3<Float>, factor: Float) -> Points {
      Points(positions: positions.map { factor * $0 + offset }, normals: normals)
    }
  }

  /// Points of a unit sphere (Fibonacci lattice) with their normals.
  private static func sphere(_ count: Int) -> Points {
    let points = (0..<count).map { index -> SIMD3<Float> in
      let z = 1 - 2 * (Float(index) + 0.5) / Float(count)
      let (radius, angle) = ((1 - z * z).squareRoot(), 2.399_963 * Float(index))
      return [radius * cos(angle), radius * sin(angle), z]
    }
    return Points(positions: points, normals: points)
  }

  /// A sphere with ten times as many points on the upper half.
  private static var unevenSphere: Points {
    let upper = sphere(20_000).positions.filter { $0.z >= 0 }
    let lower = sphere(2000).positions.filter { $0.z < 0 }
    return Points(positions: upper + lower, normals: upper + lower)
  }

  private func side(_ points: Points, depth: Int) -> Float {
    let bounds = Mesh(positions: points.positions).bounds
    return 1.1 * ((bounds?.max ?? .zero) - (bounds?.min ?? .zero)).max() / Float(1 << depth)
  }

  /// Every edge belongs to two triangles, one in each direction.
  private func isClosed(_ mesh: Mesh) -> Bool {
    var edges: [UInt64: Int] = [:]
    for t in mesh.triangles {
      for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] {
        edges[UInt64(min(a, b)) << 32 | UInt64(max(a, b)), default: 0] += a < b ? 1 : 1000
      }
    }
    return edges.values.allSatisfy { $0 % 1000 == $0 / 1000 }
  }

  private func expectEqual(_ a: Mesh, _ b: Mesh) {
    #expect(a.positions == b.positions && a.triangles == b.triangles)
  }

  @Test(arguments: [5, 6, 7]) func pointsOfASphereGiveASphere(depth: Int) throws {
    let points = Self.sphere(20_000)
    let mesh = try points.surface(depth: depth)
    #expect(isClosed(mesh))
    let limit = 0.1 * side(points, depth: depth)
    #expect(mesh.positions.allSatisfy { abs($0.length - 1) < limit })
    #expect(abs(mesh.volume - 4 * .pi / 3) < 3 * Double(limit))
  }

  /// Without memory, the octree has the levels that have all cells, whatever the points are.
  @Test func memoryLimitsTheDepth() throws {
    let points = Self.sphere(20_000)
    var reconstruction = PoissonReconstruction()
    reconstruction.depth = 7
    func surface(_ bytes: Int) throws -> (mesh: Mesh, depth: Int) {
      reconstruction.maximumBytes = bytes
      return try reconstruction.surface(
        positions: points.positions, normals: points.normals, KernelControl())
    }
    let (whole, depth) = try surface(1 << 30)
    #expect(depth == 7)
    expectEqual(whole, try points.surface(depth: 7))
    for (bytes, expected) in [(0, 5), (12 << 20, 6)] {
      let (mesh, depth) = try surface(bytes)
      #expect(depth == expected && isClosed(mesh))
      #expect(mesh.triangles.count < whole.triangles.count / 3)
    }
  }

  /// Levels meet without cracks, and the sparse part is as correct as its samples allow.
  @Test func unevenSamplesGiveAClosedSurface() throws {
    let mesh = try Self.unevenSphere.surface(depth: 7)
    #expect(isClosed(mesh))
    #expect(mesh.positions.allSatisfy { abs($0.length - 1) < 0.01 })
    let (dense, sparse) = (
      mesh.positions.count { $0.z > 0.1 }, mesh.positions.count { $0.z < -0.1 }
    )
    #expect(dense > 3 * sparse && sparse > 500)
  }

  /// Noise of half a cell is averaged out.
  @Test func noiseIsAveraged() throws {
    var points = Self.sphere(40_000)
    var random = SeededGenerator(seed: 1)
    let cell = side(points, depth: 6)
    for index in points.positions.indices {
      points.positions[index] *= 1 + cell * Float(random.uniform() - 0.5)
    }
    let mesh = try points.surface(depth: 6)
    #expect(isClosed(mesh))
    let errors = mesh.positions.map { abs($0.length - 1) / cell }
    #expect(errors.reduce(0, +) / Float(errors.count) < 0.1)
  }

  /// Two spheres, one inside the other with its normals inward: a shell.
  @Test func normalsDecideWhatIsInside() throws {
    let outer = Self.sphere(10_000)
    let points = Points(
      positions: outer.positions + outer.positions.map { 0.6 * $0 },
      normals: outer.normals + outer.normals.map { -$0 })
    let mesh = try points.surface(depth: 6)
    #expect(isClosed(mesh))
    let volume = 4 * Double.pi / 3 * (1 - 0.6 * 0.6 * 0.6)
    #expect(abs(mesh.volume - volume) < 0.02 * volume)
  }

  @Test(arguments: [1e-4, 1e4] as [Float]) func unitsDoNotMatter(factor: Float) throws {
    let mesh = try Self.sphere(5000).surface(depth: 6)
    let offset: SIMD3<Float> = [3 * factor, -factor, 0]
    let other = try Self.sphere(5000).moved(by: offset, factor: factor).surface(depth: 6)
    #expect(abs(other.triangles.count - mesh.triangles.count) < mesh.triangles.count / 20)
    #expect(other.positions.allSatisfy { abs((($0 - offset) / factor).length - 1) < 0.01 })
  }

  /// Half a sphere is continued to the sides of the cube, where it is open.
  @Test func openSurfacesEndAtTheCube() throws {
    let upper = Self.sphere(10_000).positions.filter { $0.z > 0 }
    let mesh = try Points(positions: upper, normals: upper).surface(depth: 6)
    let onSphere = mesh.positions.filter { $0.z > 0.1 && $0.length < 1.1 }
    #expect(onSphere.count > 1000 && onSphere.allSatisfy { abs($0.length - 1) < 0.01 })
  }

  @Test func invalidPointsAreIgnored() throws {
    let points = Self.sphere(2000)
    var more = points
    more.positions += [[.nan, 0, 0], [0, .infinity, 0], [5, 5, 5]]
    more.normals += [[1, 0, 0], [1, 0, 0], .zero]
    try expectEqual(more.surface(depth: 5), points.surface(depth: 5))
  }

  @Test func tooFewPointsAreDegenerate() throws {
    for points in [
      Points(), Self.sphere(3),
      Points(
        positions: Array(repeating: [1, 2, 3], count: 9),
        normals: Array(repeating: [0, 0, 1], count: 9)),
    ] {
      #expect(throws: KernelError.self) { try points.surface(depth: 5) }
    }
  }

  /// Four points, or points of a line, may give no surface, but end.
  @Test(arguments: [2, 6, 10]) func poorSamplesEnd(depth: Int) throws {
    _ = try Self.sphere(4).surface(depth: depth)
    let line = Points(
      positions: (0..<50).map { [Float($0), 0, 0] },
      normals: (0..<50).map { _ in [0, 0, 1] })
    _ = try line.surface(depth: depth)
  }

  @Test(arguments: [2, 3, 8]) func threadsDoNotMatter(count: Int) throws {
    let one = try Self.unevenSphere.surface(depth: 7, KernelControl(threadCount: 1))
    try expectEqual(
      Self.unevenSphere.surface(depth: 7, KernelControl(threadCount: count)), one)
  }

  @Test(arguments: [0.0, 0.05, 0.15, 0.3, 0.6, 0.8, 0.9]) func stopsWhenCanceled(fraction: Double) {
    let flag = CancellationFlag()
    let last = Locked(0.0)
    let control = KernelControl(threadCount: 2, flag: flag) { done in
      last.withLock { $0 = max($0, done) }
      if done >= fraction { flag.cancel() }
    }
    #expect(throws: CancellationError.self) {
      try Self.sphere(20_000).surface(depth: 7, control)
    }
    #expect(last.withLock { $0 } < fraction + 0.15)
  }

  @Test func progressGoesFromZeroToOne() throws {
    let fractions = Locked<[Double]>([])
    let control = KernelControl { done in fractions.withLock { $0.append(done) } }
    _ = try Self.sphere(5000).surface(depth: 6, control)
    let all = fractions.withLock { $0 }
    #expect(all.first == 0 && all.allSatisfy { (0...1).contains($0) })
    #expect((all.last ?? 0) > 0.95 && all.count > 100)
    #expect(zip(all, all.dropFirst()).allSatisfy { $1 - $0 < 0.2 })
  }
}
