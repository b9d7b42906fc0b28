import SceneModel

/// Square cells over a photo.
struct PhotoCells: Sendable {
  let side: Double
  let columns: Int
  let rows: Int

  init(width: Int, height: Int, cells: Int) {
    side = Double(max(width, height)) / Double(max(1, cells))
    columns = max(1, Int((Double(width) / side).rounded(.up)))
    rows = max(1, Int((Double(height) / side).rounded(.up)))
  }

  func place(_ pixel: SIMD2<Double>) -> (column: Int, row: Int) {
    (
      min(columns - 1, max(0, Int(pixel.x / side))), min(rows - 1, max(0, Int(pixel.y / side)))
    )
  }
}

/// The depths that a photo shows, by cell.
struct DepthGrid: Sendable {
  private let cells: PhotoCells
  private var points: [[(pixel: SIMD2<Double>, depth: Double)]]
  /// Of all points; nil without any.
  private(set) var medianDepth: Double?

  init(_ camera: Camera, _ seen: [(pixel: SIMD2<Double>, depth: Double)], cells count: Int) {
    cells = PhotoCells(width: camera.width, height: camera.height, cells: count)
    points = Array(repeating: [], count: cells.columns * cells.rows)
    for point in seen {
      let (column, row) = cells.place(point.pixel)
      points[row * cells.columns + column].append(point)
    }
    let depths = seen.map(\.depth).sorted()
    medianDepth = depths.isEmpty ? nil : depths[depths.count / 2]
  }

  /// The least depth within a cell's side of a pixel; nil where nothing is seen.
  func front(at pixel: SIMD2<Double>) -> Double? {
    let (column, row) = cells.place(pixel)
    var front: Double?
    for y in max(0, row - 1)...min(cells.rows - 1, row + 1) {
      for x in max(0, column - 1)...min(cells.columns - 1, column + 1) {
        for point in points[y * cells.columns + x]
        where (point.pixel - pixel).length <= cells.side {
          front = min(front ?? .infinity, point.depth)
        }
      }
    }
    return front
  }
}

/// Points that agree and that contradict, by cell.
struct AgreementGrid: Sendable {
  private let cells: PhotoCells
  private var agreeing: [Int]
  private var contradicting: [Int]

  init(_ photo: Photo, cells count: Int) {
    cells = PhotoCells(width: photo.width, height: photo.height, cells: count)
    agreeing = Array(repeating: 0, count: cells.columns * cells.rows)
    contradicting = agreeing
  }

  private func index(_ pixel: SIMD2<Double>) -> Int {
    let (column, row) = cells.place(pixel)
    return row * cells.columns + column
  }

  mutating func agree(_ pixel: SIMD2<Double>) { agreeing[index(pixel)] += 1 }

  mutating func contradict(_ pixel: SIMD2<Double>) { contradicting[index(pixel)] += 1 }

  /// Cells with at least `minimum` points that contradict, and less than half as many that agree.
  func contradictingCells(minimum: Int) -> Int {
    agreeing.indices.count {
      contradicting[$0] >= minimum && contradicting[$0] > 2 * agreeing[$0]
    }
  }
}
