import Foundation
import Kernels
import SceneModel

/// Divides the cube of a scene into boxes with about the same number of points.
struct TileGrid: Hashable, Codable, Sendable {
  /// The cube in which the surface is solved, in the frame of the cloud.
  let cube: Cube
  /// The level whose cells the boxes consist of.
  let depth: Int
  /// Boxes that fill the cube without overlap, each with points.
  private(set) var boxes: [CellBox]
  /// The number of points in each box.
  private(set) var pointCounts: [Int]

  /// Halves the box with too many points at the plane between cells that divides them best, across
  /// its longest side, until all have at most `maximumPoints` or are one cell.
  init(_ counts: CellCounts, maximumPoints: Int) {
    (cube, depth) = (counts.cube, counts.depth)
    (boxes, pointCounts) = ([], [])
    var rest = [(Self.whole(counts.depth), counts.cells)]
    while let (box, cells) = rest.popLast() {
      let split = Self.split(cells.map { ($0.key, $0.value) }, maximumPoints)
      guard let split else {
        guard !cells.isEmpty else { continue }
        boxes.append(box)
        pointCounts.append(cells.values.reduce(0, +))
        continue
      }
      var (first, second) = (box, box)
      first.high[split.axis] = split.plane
      second.low[split.axis] = split.plane
      rest.append((second, cells.filter { $0.key[split.axis] >= split.plane }))
      rest.append((first, cells.filter { $0.key[split.axis] < split.plane }))
    }
  }

  /// The plane that halves some cells' points; nil if they are few enough or in one cell.
  private static func split(
    _ cells: [(cell: SIMD3<Int32>, count: Int)], _ maximumPoints: Int
  ) -> (axis: Int, plane: Int32)? {
    let total = cells.reduce(0) { $0 + $1.count }
    guard total > maximumPoints, let first = cells.first?.cell else { return nil }
    let low = cells.reduce(first) { pointwiseMin($0, $1.cell) }
    let extent = cells.reduce(first) { pointwiseMax($0, $1.cell) } &- low
    let axis = (0..<3).max { extent[$0] < extent[$1] } ?? 0
    guard extent[axis] > 0 else { return nil }
    var slices = [Int](repeating: 0, count: Int(extent[axis]) + 1)
    for (cell, count) in cells { slices[Int(cell[axis] - low[axis])] += count }
    var (before, best) = (0, (plane: 1, difference: Int.max))
    for (slice, count) in slices.dropLast().enumerated() {
      before += count
      let difference = abs(total - 2 * before)
      if difference < best.difference { best = (slice + 1, difference) }
    }
    return (axis, low[axis] + Int32(best.plane))
  }
}

extension TileGrid {
  /// The box of the whole cube.
  var whole: CellBox { Self.whole(depth) }

  private static func whole(_ depth: Int) -> CellBox {
    CellBox(depth: depth, low: .zero, high: .init(repeating: 1 << Int32(depth)))
  }

  /// Side of a cell, in world units.
  var cellSize: Double { cube.side / exp2(Double(depth)) }

  /// The tile that a point belongs to is the one whose box has its cell; beyond the sides of the
  /// cube, the nearest cell.
  func cell(nearest point: SIMD3<Double>) -> SIMD3<Int32> {
    let cell = ((point - cube.origin) / cellSize).rounded(.down)
    let last = Double((1 << depth) - 1)
    return SIMD3<Int32>(pointwiseMin(pointwiseMax(cell, .zero), .init(repeating: last)))
  }

  /// A box in the frame of the cloud: its lowest and its highest corner.
  func corners(of box: CellBox) -> (low: SIMD3<Double>, high: SIMD3<Double>) {
    (
      cube.origin + SIMD3<Double>(box.low) * cellSize,
      cube.origin + SIMD3<Double>(box.high) * cellSize
    )
  }
}
