import CKernels

/// A box of cells of one level of an octree: from `low` to before `high` per axis. A node belongs
/// to the cell of which it is the lowest corner.
package struct CellBox: Hashable, Codable, Sendable {
  /// The level: the cube has `2^depth` cells per axis.
  package var depth: Int
  package var low: SIMD3<Int32>
  package var high: SIMD3<Int32>

  package init(depth: Int, low: SIMD3<Int32>, high: SIMD3<Int32>) {
    (self.depth, self.low, self.high) = (depth, low, high)
  }

  /// Whether a cell of its level is in the box.
  package func contains(_ cell: SIMD3<Int32>) -> Bool {
    (0..<3).allSatisfy { low[$0] <= cell[$0] && cell[$0] < high[$0] }
  }

  /// Whether two boxes of a level have a cell in common.
  package func overlaps(_ other: CellBox) -> Bool {
    (0..<3).allSatisfy { low[$0] < other.high[$0] && other.low[$0] < high[$0] }
  }

  /// The box with `count` more cells on each side, within the cube.
  package func dilated(by count: Int) -> CellBox {
    let (zero, side) = (SIMD3<Int32>.zero, SIMD3<Int32>(repeating: 1 << Int32(depth)))
    return CellBox(
      depth: depth, low: pointwiseMax(low &- Int32(count), zero),
      high: pointwiseMin(high &+ Int32(count), side))
  }

  /// Calls `body` with the C representation, valid only during the call.
  func withKernelValue<Result>(
    _ body: (UnsafePointer<ck_cell_box>) throws -> Result
  ) rethrows -> Result {
    var box = ck_cell_box(
      depth: Int32(depth), low: (low.x, low.y, low.z), high: (high.x, high.y, high.z))
    return try body(&box)
  }
}
