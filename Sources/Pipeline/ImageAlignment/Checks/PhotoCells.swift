import SceneModel

/// A grid of square cells over a photo.
struct PhotoCells: Sendable {
  /// Side of a cell in pixels.
  let side: Double
  let columns: Int
  let rows: Int

  /// `cells` is the number of cells along the longer side.
  init(width: Int, height: Int, cells: Int) {
    side = Double(max(width, height)) / Double(max(1, cells))
    columns = max(1, Int((Double(width) / side).rounded(.up)))
    rows = max(1, Int((Double(height) / side).rounded(.up)))
  }

  /// The cell of a pixel, clamped to the grid.
  func cell(of pixel: SIMD2<Double>) -> (column: Int, row: Int) {
    (
      min(columns - 1, max(0, Int(pixel.x / side))), min(rows - 1, max(0, Int(pixel.y / side)))
    )
  }
}
