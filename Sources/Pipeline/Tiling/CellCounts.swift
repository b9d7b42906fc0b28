import Kernels
import SceneModel

/// The numbers of points in the cells of a level.
struct CellCounts: Sendable {
  let cube: Cube
  let depth: Int
  /// In the order of x, y and z.
  private var counts: [Int32]

  init(cube: Cube, depth: Int) {
    (self.cube, self.depth) = (cube, depth)
    counts = Array(repeating: 0, count: 1 << (3 * depth))
  }

  /// The numbers of points of the cells that have some.
  var cells: [SIMD3<Int32>: Int] {
    let last = (1 << depth) - 1
    var cells: [SIMD3<Int32>: Int] = [:]
    for (index, count) in counts.enumerated() where count > 0 {
      let cell = SIMD3(index >> (2 * depth), index >> depth & last, index & last)
      cells[SIMD3<Int32>(truncatingIfNeeded: cell)] = Int(count)
    }
    return cells
  }

  /// Counts points; those outside the cube are ignored. Returns the box around their cells.
  @discardableResult
  mutating func add(_ positions: [SIMD3<Float>]) -> CellBox? {
    var box: CellBox?
    for position in positions {
      guard let cell = cube.cell(of: position, depth: depth) else { continue }
      counts[((Int(cell.x) << depth | Int(cell.y)) << depth) | Int(cell.z)] += 1
      let (low, high) = (box?.low ?? cell, box?.high ?? cell)
      box = CellBox(
        depth: depth, low: pointwiseMin(low, cell), high: pointwiseMax(high, cell &+ 1))
    }
    return box
  }
}

extension Cube {
  /// The cell of a level that holds a point; nil outside the cube.
  func cell(of position: SIMD3<Float>, depth: Int) -> SIMD3<Int32>? {
    let cells = Double(1 << depth)
    let scaled = (SIMD3<Double>(position) - origin) / side * cells
    guard (0..<3).allSatisfy({ scaled[$0] >= 0 && scaled[$0] < cells }) else { return nil }
    return SIMD3<Int32>(scaled)
  }
}
