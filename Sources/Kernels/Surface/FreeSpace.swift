import CKernels
import SceneModel

/// Counts the photos that see through each cell of a grid to a surface behind it.
package struct FreeSpace: Sendable {
  /// Cells per side, at most. Chosen.
  package static let maximumCells = 320

  private let grid: ck_free_space_grid
  private let counts: [UInt8]

  /// Traces the rays of all photos to the points of `cloud` that they observe.
  ///
  /// `clearances` holds, for each point, how far in front of it a ray ends, in world units;
  /// `centers` the camera center of each photo in the world frame. Cells have a side of `cellSize`,
  /// or more where the box between `low` and `high` would have more than `maximumCells`, and start
  /// at `origin` if it is given instead of `low`.
  package init(
    low: SIMD3<Float>, high: SIMD3<Float>, origin: SIMD3<Double>? = nil, cellSize: Double,
    cloud: PointCloud, clearances: [Float], centers: [SIMD3<Float>], _ control: KernelControl
  ) throws {
    guard clearances.count == cloud.count, cloud.photoOffsets.count == cloud.count + 1,
      Int(cloud.photoOffsets.last ?? 0) <= cloud.photoIndices.count
    else { throw KernelError.invalidArgument("the cloud's arrays do not fit each other") }
    let extent = Double((high - low).max())
    let side = max(cellSize, extent / Double(Self.maximumCells))
    guard side > 0, side.isFinite else {
      throw KernelError.invalidArgument("the box of free space has no size")
    }
    let size = (0..<3).map { Int32((Double(high[$0] - low[$0]) / side).rounded(.down)) + 1 }
    let origin = origin ?? SIMD3<Double>(low)
    let grid = ck_free_space_grid(
      origin: (origin.x, origin.y, origin.z), cell_size: side,
      size: (size[0], size[1], size[2]))
    var counts = [UInt8](repeating: 0, count: size.reduce(1) { $0 * Int($1) })
    var rawGrid = grid
    let (clearances, offsets) = (KernelArray(clearances), KernelArray(cloud.photoOffsets))
    let photos = KernelArray(cloud.photoIndices)
    try withExtendedLifetime((clearances, offsets, photos)) {
      try withKernel(control) { control in
        withSpans(cloud.positions, centers) { positions, centers in
          var points = ck_seen_points(
            positions: positions, clearances: clearances.base, photo_offsets: offsets.base,
            photos: photos.base)
          return ck_free_space(&rawGrid, &points, centers, control, &counts)
        }
      }
    }
    (self.grid, self.counts) = (grid, counts)
  }

  /// Side of the cells in world units.
  package var cellSize: Double { grid.cell_size }

  /// The number of photos that see through the cell containing a point, at most 255; 0 outside the
  /// box.
  package func photos(at point: SIMD3<Float>) -> Int {
    let (origin, size) = (grid.origin, grid.size)
    let x = ((Double(point.x) - origin.0) / grid.cell_size).rounded(.down)
    let y = ((Double(point.y) - origin.1) / grid.cell_size).rounded(.down)
    let z = ((Double(point.z) - origin.2) / grid.cell_size).rounded(.down)
    guard x >= 0, y >= 0, z >= 0, x < Double(size.0), y < Double(size.1), z < Double(size.2) else {
      return 0
    }
    return Int(counts[(Int(z) * Int(size.1) + Int(y)) * Int(size.0) + Int(x)])
  }
}
