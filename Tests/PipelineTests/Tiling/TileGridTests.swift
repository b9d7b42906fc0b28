import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct TileGridTests {
  private static let cube = Cube(origin: [-1, -1, -1], side: 2)

  /// Points of a sheet that are denser toward a corner.
  private static let points: [SIMD3<Float>] = {
    var random = SeededGenerator(seed: 2)
    return (0..<20_000).map { _ in
      let (x, y) = (Float(random.uniform()), Float(random.uniform()))
      return [2 * x * x - 1, 2 * y * y - 1, 0.01]
    }
  }()

  private func grid(_ maximum: Int) -> TileGrid {
    var counts = CellCounts(cube: Self.cube, depth: 6)
    counts.add(Self.points)
    return TileGrid(counts, maximumPoints: maximum)
  }

  private func contains(_ box: CellBox, _ cell: SIMD3<Int32>) -> Bool {
    (0..<3).allSatisfy { box.low[$0] <= cell[$0] && cell[$0] < box.high[$0] }
  }

  @Test func boxesFillTheCubeWithoutOverlap() {
    let boxes = grid(1500).boxes
    #expect(boxes.count >= 14)
    for x: Int32 in 0..<64 {
      for y: Int32 in 0..<64 {
        for z: Int32 in [0, 31, 32, 63] {
          #expect(boxes.count { contains($0, [x, y, z]) } == 1)
        }
      }
    }
  }

  @Test func boxesHaveFewEnoughPoints() throws {
    let grid = grid(1500)
    for (box, found) in zip(grid.boxes, grid.pointCounts) {
      let count = Self.points.count { point in
        Self.cube.cell(of: point, depth: 6).map { contains(box, $0) } == true
      }
      #expect(found == count)
      let isOneCell = (0..<2).allSatisfy { box.high[$0] - box.low[$0] == 1 }
      #expect(count > 0 && (count <= 1500 || isOneCell))
    }
  }

  @Test func fewPointsAreOneBox() {
    #expect(grid(20_000).boxes == [CellBox(depth: 6, low: .zero, high: [64, 64, 64])])
  }

  @Test func pointsOutsideTheCubeAreIgnored() {
    var counts = CellCounts(cube: Self.cube, depth: 3)
    counts.add([[.nan, 0, 0], [2, 0, 0], [0, -1.1, 0], [1, 0, 0], [.infinity, 0, 0]])
    #expect(counts.cells.isEmpty)
    counts.add([[-1, -1, -1]])
    #expect(counts.cells == [[0, 0, 0]: 1])
  }
}
