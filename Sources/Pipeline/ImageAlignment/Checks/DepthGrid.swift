import SceneModel

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
