import SceneModel

/// The features of a photo by cells, to find those near a pixel.
struct FeatureGrid {
  /// Distance from a pixel up to which features are found, in pixels.
  let reach: Double
  private let positions: [SIMD2<Float>]
  private let columns: Int
  private let rows: Int
  private var cells: [[Int32]]

  init(_ positions: [SIMD2<Float>], width: Int, height: Int, reach: Double) {
    (self.positions, self.reach) = (positions, max(1, reach))
    columns = Int(Double(width) / self.reach) + 1
    rows = Int(Double(height) / self.reach) + 1
    cells = Array(repeating: [], count: columns * rows)
    for (index, position) in positions.enumerated() {
      let (column, row) = cell(of: SIMD2<Double>(position))
      cells[row * columns + column].append(Int32(index))
    }
  }

  /// The features within `reach` of a pixel; none for pixels outside the photo.
  func features(near pixel: SIMD2<Double>) -> [Int] {
    guard pixel.x >= 0, pixel.y >= 0, pixel.x < Double(columns) * reach,
      pixel.y < Double(rows) * reach
    else { return [] }
    let (column, row) = cell(of: pixel)
    var found: [Int] = []
    for y in max(0, row - 1)...min(rows - 1, row + 1) {
      for x in max(0, column - 1)...min(columns - 1, column + 1) {
        found += cells[y * columns + x].map(Int.init).filter {
          (SIMD2<Double>(positions[$0]) - pixel).length <= reach
        }
      }
    }
    return found
  }

  /// The cell of a pixel, clamped to the grid.
  private func cell(of pixel: SIMD2<Double>) -> (column: Int, row: Int) {
    (
      min(columns - 1, max(0, Int(pixel.x / reach))), min(rows - 1, max(0, Int(pixel.y / reach)))
    )
  }
}
