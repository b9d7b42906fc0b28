import CKernels
import SceneModel

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
    var components = findsComponents ? cells : []
    var (cellCount, componentCount) = (0, 0)
    try withKernel(control) { control in
      positions.withUnsafeBytes { bytes in
        cells.withUnsafeMutableBufferPointer { cells in
          components.withUnsafeMutableBufferPointer { components in
            (levels ?? []).withUnsafeBufferPointer { levels in
              ck_voxel_cells(
                bytes.floats, MemoryLayout<SIMD3<Float>>.stride, cells.count, cellSize,
                levels.isEmpty ? nil : levels.baseAddress, control, cells.baseAddress, &cellCount,
                components.isEmpty ? nil : components.baseAddress, &componentCount)
            }
          }
        }
      }
    }
    (self.cells, self.cellCount) = (cells, cellCount)
    (self.components, self.componentCount) = (components, componentCount)
  }
}
