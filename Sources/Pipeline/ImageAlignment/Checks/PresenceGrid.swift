import SceneModel

/// Counts of present and absent points, by cell.
struct PresenceGrid: Sendable {
  private let cells: PhotoCells
  private var present: [Int]
  private var absent: [Int]

  init(_ photo: Photo, cells count: Int) {
    cells = PhotoCells(width: photo.width, height: photo.height, cells: count)
    present = Array(repeating: 0, count: cells.columns * cells.rows)
    absent = present
  }

  private func index(_ pixel: SIMD2<Double>) -> Int {
    let (column, row) = cells.cell(of: pixel)
    return row * cells.columns + column
  }

  mutating func countPresent(_ pixel: SIMD2<Double>) { present[index(pixel)] += 1 }

  mutating func countAbsent(_ pixel: SIMD2<Double>) { absent[index(pixel)] += 1 }

  /// The number of cells with at least `minimum` absent points and fewer than half as many present
  /// ones.
  func contradictingCells(minimum: Int) -> Int {
    present.indices.count { isContradicting($0, minimum) }
  }

  /// Whether the cell of a pixel is one of these.
  func isContradicting(_ pixel: SIMD2<Double>, minimum: Int) -> Bool {
    isContradicting(index(pixel), minimum)
  }

  private func isContradicting(_ cell: Int, _ minimum: Int) -> Bool {
    absent[cell] >= minimum && absent[cell] > 2 * present[cell]
  }
}
