import Foundation
import Kernels
import SceneModel

/// Voxel downsampling: merges redundant points to one mean point per voxel, weighted by
/// consistency.
///
/// The voxel size grows in powers of two with the point's footprint, so that coarse parts of a
/// scene stay coarse. Averaging reduces noise and makes Poisson reconstruction faster (rule of
/// thumb: as many samples as cells).
struct VoxelDownsampling {
  struct Options: Hashable, Codable, Sendable {
    /// Side of a voxel in median footprints. Chosen.
    var voxelFootprints = 1.0
    /// Minimum weight of a point; weights are the points' consistencies. Chosen.
    var minimumWeight = 0.01
    /// A point needs this number of others within `outlierRadius` spacings: isolated points are
    /// mostly false matches, and each distorts a Poisson surface. Chosen.
    var outlierNeighbors = 5
    var outlierRadius = 4.0

    init() {}
  }

  struct Result: Sendable {
    var cloud: PointCloud
    /// The mean point of every input point; −1 for inputs that are not kept or not finite.
    var sampleOfPoint: [Int32]
    /// Number of input points of each mean point.
    var weights: [Int32]
    /// Side of the smallest voxel in world units.
    var voxelSize: Double
  }

  var options = Options()

  /// The mean points of those that are kept, of all by default; `footprint` stands for their median
  /// for a part of a cloud. Throws `PipelineError.noSurface` if there are none.
  func run(
    _ cloud: PointCloud, keeping isKept: [Bool]? = nil, footprint: Float? = nil,
    _ context: StageContext
  ) throws -> Result {
    var kept = PointCloud(positions: cloud.positions, footprints: cloud.footprints)
    if let isKept {
      kept.positions = kept.positions.voided(unless: isKept)
      for index in isKept.indices where !isKept[index] { kept.footprints[index] = 0 }
    }
    guard let footprint = footprint ?? kept.medianFootprint, footprint > 0 else {
      throw PipelineError.noSurface(reason: "the point cloud is empty.")
    }
    let size = Double(footprint) * options.voxelFootprints
    let unit = 8192  // Points of a unit of parallel work. Chosen.
    let levels = try context.control.part(from: 0, to: 0.1)
      .parallelMap(cloud.count, inUnitsOf: unit) {
        cloud.footprints[$0].map { value -> Int8 in
          value > footprint * 2 && value.isFinite
            ? Int8(min(20, log2(value / footprint).rounded(.down))) : 0
        }
      }
    let grid = try VoxelGrid(
      kept.positions, cellSize: size, levels: levels, findsMembers: true,
      context.control.part(from: 0.1, to: 0.7))
    kept = PointCloud()
    try context.control.step(0.7)
    return try average(cloud, grid, size, context.control.part(from: 0.7, to: 1))
  }

  /// One mean point per occupied grid cell, with the union of its members' photos.
  private func average(
    _ cloud: PointCloud, _ grid: VoxelGrid, _ size: Double, _ control: KernelControl
  ) throws -> Result {
    let members = Members(of: grid)
    // Cells of a unit of parallel work, and units that are made at a time. Chosen.
    let (unit, unitsAtATime) = (8192, 64)
    var result = PointCloud()
    result.reserveCapacity(points: grid.cellCount, photos: cloud.photoIndices.count)
    try readingAhead(grid.cellCount, by: unit * unitsAtATime, control) { cells, control in
      try control.parallelMap(cells, perUnitOf: unit) {
        average($0, of: members, cloud, Float(size))
      }
    } use: { _, parts in
      for part in parts { result.append(part) }
    }
    return Result(
      cloud: result, sampleOfPoint: grid.cells,
      weights: (0..<grid.cellCount).map { Int32(members.places(of: $0).count) }, voxelSize: size)
  }

  /// The mean points of some cells; `fallback` is the footprint of a point if none of its cell has
  /// one.
  private func average(
    _ cells: Range<Int>, of members: Members, _ cloud: PointCloud, _ fallback: Float
  ) -> PointCloud {
    var result = PointCloud()
    var photos: [UInt16] = []
    for cell in cells {
      append(cell, of: members, cloud, to: &result, fallback: fallback)
      photos.removeAll(keepingCapacity: true)
      for place in members.places(of: cell) {
        for visibility in cloud.visibilities(of: members[at: place]) {
          photos.append(cloud.photoIndices[visibility])
        }
      }
      photos.sort()
      var last: UInt16?
      for photo in photos where photo != last {
        result.photoIndices.append(photo)
        last = photo
      }
      result.photoOffsets.append(UInt32(result.photoIndices.count))
    }
    return result
  }

  /// Appends the weighted mean of the points of a cell, without their photos; `fallback` is the
  /// footprint if none of them has one.
  private func append(
    _ cell: Int, of members: Members, _ cloud: PointCloud, to result: inout PointCloud,
    fallback: Float
  ) {
    var (position, normal, color) = (SIMD3<Double>(), SIMD3<Double>(), SIMD3<Double>())
    var (consistency, footprint, sum) = (0.0, Float.infinity, 0.0)
    for place in members.places(of: cell) {
      let i = members[at: place]
      let value = cloud.consistency.isEmpty ? 1 : Double(cloud.consistency[i])
      let weight = max(
        options.minimumWeight, value.isFinite ? value : options.minimumWeight)
      position += weight * SIMD3<Double>(cloud.positions[i])
      if !cloud.normals.isEmpty { normal += weight * SIMD3<Double>(cloud.normals[i]) }
      if !cloud.colors.isEmpty { color += weight * SIMD3<Double>(cloud.colors[i]) }
      consistency = max(consistency, value)
      if cloud.footprints[i] > 0 { footprint = min(footprint, cloud.footprints[i]) }
      sum += weight
    }
    result.positions.append(SIMD3<Float>(position / sum))
    if !cloud.normals.isEmpty { result.normals.append(SIMD3<Float>(normal.normalized)) }
    if !cloud.colors.isEmpty {
      result.colors.append(SIMD3<UInt8>((color / sum).rounded(.toNearestOrAwayFromZero)))
    }
    result.consistency.append(Float(consistency))
    result.footprints.append(footprint.isFinite ? footprint : fallback)
  }
}

extension VoxelDownsampling {
  /// Removes isolated mean points, those with few others within a radius. It grows with their
  /// footprint up to `coarsest`, by default that of nearly all points; a part of a cloud needs that
  /// of the whole.
  func removeOutliers(
    from cloud: inout PointCloud, voxelSize: Double, coarsest: Float? = nil,
    _ control: KernelControl
  ) throws {
    let (radius, voxel) = (Float(options.outlierRadius), Float(voxelSize))
    let coarsest = max(voxel, coarsest ?? cloud.footprints.quantile(0.99) ?? 0)
    let isKept = try PointNeighbors.atLeast(
      options.outlierNeighbors, of: cloud.positions,
      within: cloud.footprints.map { radius * min(coarsest, max(voxel, $0)) }, control)
    cloud.retain(isKept)
  }
}

extension [SIMD3<Float>] {
  /// The positions, those that are not kept without a number: a `VoxelGrid` leaves them out.
  func voided(unless isKept: [Bool]) -> Self {
    var result = self
    for index in isKept.indices where !isKept[index] { result[index] = SIMD3(repeating: .nan) }
    return result
  }
}
