import Kernels
import SceneModel

/// The numbers of points in the cells of a level.
struct CellCounts: Sendable {
  let cube: Cube
  let depth: Int
  private(set) var cells: [SIMD3<Int32>: Int] = [:]

  init(cube: Cube, depth: Int) { (self.cube, self.depth) = (cube, depth) }

  /// Counts points; those outside the cube are ignored. Returns the box around their cells.
  @discardableResult
  mutating func add(_ positions: [SIMD3<Float>]) -> CellBox? {
    var box: CellBox?
    for position in positions {
      guard let cell = cube.cell(of: position, depth: depth) else { continue }
      cells[cell, default: 0] += 1
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
