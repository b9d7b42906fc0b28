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
    }
  }
}
