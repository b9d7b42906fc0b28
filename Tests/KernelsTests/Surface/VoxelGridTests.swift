import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct VoxelGridTests {
  /// So many points are sorted in parallel.
  @Test func manyPointsAreGroupedByCell() throws {
    var random = SeededGenerator(seed: 5)
    let points = (0..<100_000).map { _ in SIMD3<Float>(random.normal3()) }
    let cells = points.map { SIMD3<Int32>(($0 / 0.125).rounded(.down)) }
    let distinct = Set(cells).sorted { ($0.x, $0.y, $0.z) < ($1.x, $1.y, $1.z) }
    let numbers = Dictionary(uniqueKeysWithValues: zip(distinct, Int32(0)...))
    for threads in [1, 2, 3, 8] {
      let grid = try VoxelGrid(
        points, cellSize: 0.125, KernelControl(threadCount: threads))
      #expect(grid.cellCount == distinct.count)
      #expect(grid.cells == cells.map { numbers[$0] })
      #expect(grid.members.isEmpty && grid.starts.isEmpty)
    }
  }

  /// Cells so far from each other that their numbers don't fit into 64 bits, and points that are
  /// left out.
  @Test func distantCellsAreDistinguished() throws {
    var random = SeededGenerator(seed: 6)
    var points = (0..<1000).map { _ in
      // Half of them in few cells.
      random.uniform() < 0.5
        ? SIMD3<Float>(random.normal3()) * 0.002 : SIMD3<Float>(random.normal3()) * 1e5
    }
    points[7].x = .nan
    let cells = points.map { SIMD3<Double>($0) / 0.001 }
      .map { SIMD3<Double>($0.x.rounded(.down), $0.y.rounded(.down), $0.z.rounded(.down)) }
    let distinct = Set(cells.filter { $0.x.isFinite })
      .sorted { ($0.x, $0.y, $0.z) < ($1.x, $1.y, $1.z) }
    let numbers = Dictionary(uniqueKeysWithValues: zip(distinct, Int32(0)...))
    let grid = try VoxelGrid(
      points, cellSize: 0.001, findsMembers: true, KernelControl(threadCount: 2))
    #expect(grid.cells == cells.map { numbers[$0] ?? -1 })
    #expect(grid.members.count == 999 && grid.starts.count == distinct.count + 1)
    for cell in distinct.indices {
      let members = grid.members[Int(grid.starts[cell])..<Int(grid.starts[cell + 1])]
      #expect(Array(members) == (0..<1000).filter { grid.cells[$0] == cell }.map { Int32($0) })
    }
  }
}
