import SceneModel

/// Voxel grid downsampling: replaces the points of each voxel by their mean.
struct VoxelAveraging {
  /// Side of a voxel; enlarged if the points extend over more than 2²⁰ voxels along an axis, whose
  /// numbers take 21 bits each.
  var side: Double

  private struct Sum {
    var position = SIMD3<Double>.zero
    var count = 0.0
  }

  /// Returns the means in order of first occurrence of their voxels. Points must be finite.
  func run(_ points: [SIMD3<Float>]) -> [SIMD3<Float>] {
    guard let first = points.first else { return [] }
    let low = SIMD3<Double>(points.reduce(first, pointwiseMin))
    let extent = (SIMD3<Double>(points.reduce(first, pointwiseMax)) - low).max()
    let side = max(side, extent / Double(1 << 20), .leastNormalMagnitude)
    var slots: [UInt64: Int] = [:]
    var sums: [Sum] = []
    for point in points.map({ SIMD3<Double>($0) }) {
      let cell = SIMD3<UInt64>((point - low) / side)
      let key = cell.x | cell.y << 21 | cell.z << 42
      let slot = slots[key] ?? sums.count
      if slot == sums.count {
        slots[key] = slot
        sums.append(Sum())
      }
      sums[slot].position += point
      sums[slot].count += 1
    }
    return sums.map { SIMD3<Float>($0.position / $0.count) }
  }
}
