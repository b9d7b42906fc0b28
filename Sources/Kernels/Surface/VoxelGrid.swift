import CKernels

/// Points assigned to the cells of a cubic grid.
package struct VoxelGrid: Sendable {
  /// Every point's cell, numbered in lexicographic order of (level, x, y, z); −1 for points that
  /// are not finite.
  package var cells: [Int32]
  /// Number of occupied cells.
  package var cellCount: Int
  /// The finite points by cell, ascending in each, and where those of each cell start; the last
  /// number is where the last ones end. Empty unless requested.
  package var members: [Int32] = []
  package var starts: [Int32] = []
  /// Every point's connected component of cells (26-neighborhood), numbered by their first cell;
  /// empty unless requested.
  package var components: [Int32] = []
  /// Number of components; 0 unless requested.
  package var componentCount = 0

  /// Assigns `positions` to cells of side `cellSize`, or `cellSize · 2^level` with `levels`; cells
  /// of different levels are not connected.
  package init(
    _ positions: [SIMD3<Float>], cellSize: Double, levels: [Int8]? = nil,
    findsMembers: Bool = false, findsComponents: Bool = false, _ control: KernelControl
  ) throws {
    guard levels == nil || levels?.count == positions.count else {
      throw KernelError.invalidArgument("as many levels as positions are needed")
    }
    var cells = [Int32](repeating: -1, count: positions.count)
    let components = findsComponents ? KernelArray(cells) : nil
    var members = [Int32](repeating: 0, count: findsMembers ? positions.count : 0)
    var starts = [Int32](repeating: 0, count: findsMembers ? positions.count + 1 : 0)
    var (cellCount, componentCount) = (0, 0)
    try withKernel(control) { control in
      positions.withSpan {
        ck_voxel_cells(
          $0, cellSize, levels, control, &cells, &cellCount, &members, &starts, findsMembers,
          components?.base, &componentCount)
      }
    }
    (self.cells, self.cellCount) = (cells, cellCount)
    if findsMembers {
      starts.removeLast(starts.count - cellCount - 1)
      members.removeLast(members.count - Int(starts[cellCount]))
    }
    (self.members, self.starts) = (members, starts)
    if let components { self.components = Array(components.elements) }
    self.componentCount = componentCount
  }
}
