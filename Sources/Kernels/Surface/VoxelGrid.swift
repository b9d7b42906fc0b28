import CKernels

/// Points assigned to the cells of a cubic grid.
package struct VoxelGrid: Sendable {
  /// Every point's cell, numbered in lexicographic order of (level, x, y, z); −1 for points that
  /// are not finite.
  package var cells: [Int32]
  /// Number of occupied cells.
  package var cellCount: Int
  /// Every point's connected component of cells (26-neighborhood), numbered by their first cell;
  /// empty unless requested.
  package var components: [Int32] = []
  /// Number of components; 0 unless requested.
  package var componentCount = 0

  /// Assigns `positions` to cells of side `cellSize`, or `cellSize · 2^level` with `levels`; cells
  /// of different levels are not connected.
  package init(
    _ positions: [SIMD3<Float>], cellSize: Double, levels: [Int8]? = nil,
    findsComponents: Bool = false, _ control: KernelControl
  ) throws {
    guard levels == nil || levels?.count == positions.count else {
      throw KernelError.invalidArgument("as many levels as positions are needed")
    }
    var cells = [Int32](repeating: -1, count: positions.count)
    let components = findsComponents ? KernelArray(cells) : nil
    var (cellCount, componentCount) = (0, 0)
    try withKernel(control) { control in
      positions.withSpan {
        ck_voxel_cells(
          $0, cellSize, levels, control, &cells, &cellCount, components?.base,
          &componentCount)
      }
    }
    (self.cells, self.cellCount) = (cells, cellCount)
    if let components { self.components = Array(components.elements) }
    self.componentCount = componentCount
  }
}
