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

/// The depths that a photo observes, by cell.
struct DepthGrid: Sendable {
  private let cells: PhotoCells
  private var points: [[(pixel: SIMD2<Double>, depth: Double)]]
  /// Median depth of all points; nil without any.
  private(set) var medianDepth: Double?

  init(_ camera: Camera, _ seen: [(pixel: SIMD2<Double>, depth: Double)], cells count: Int) {
    cells = PhotoCells(width: camera.width, height: camera.height, cells: count)
    points = Array(repeating: [], count: cells.columns * cells.rows)
    for point in seen {
      let (column, row) = cells.cell(of: point.pixel)
      points[row * cells.columns + column].append(point)
    }
    medianDepth = seen.map(\.depth).upperMedian
  }

  /// The smallest depth within one cell side of a pixel; nil if nothing is observed there.
  func nearestDepth(at pixel: SIMD2<Double>) -> Double? {
    let (column, row) = cells.cell(of: pixel)
    var nearestDepth: Double?
    for y in max(0, row - 1)...min(cells.rows - 1, row + 1) {
      for x in max(0, column - 1)...min(cells.columns - 1, column + 1) {
        for point in points[y * cells.columns + x]
        where (point.pixel - pixel).length <= cells.side {
          nearestDepth = min(nearestDepth ?? .infinity, point.depth)
        }
      }
    }
    return nearestDepth
  }
}

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
