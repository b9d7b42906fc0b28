import Foundation
import SceneModel

/// Thins a cloud that does not fit the memory: of the points in a voxel, the most consistent one
/// remains.
///
/// Voxels are about as large as the points' footprints, and not smaller than a size for all, so
/// that what was photographed from far away, which is sparse already, loses little before the rest
/// has become as sparse. The cloud is read in parts, three times, and never held as a whole.
struct CloudThinning {
  /// The number of points that remain, at most, but for the error of an estimate.
  let maximumPoints: Int

  /// Sizes of voxels that are tried, each larger by this factor than the one before. Chosen.
  private static let (sizes, growth) = (40, Float(1.25))
  /// One of this many voxels is counted to estimate their number: a power of two. Chosen: 5 million
  /// voxels are estimated to 0.4 %.
  private static let countedShare: UInt64 = 64

  /// Whether a cloud of `count` points needs it.
  func isNeeded(for count: Int) -> Bool { count > maximumPoints }

  /// The points that remain of the clouds `part(0)`, `part(1)` …, in their order.
  func run(
    parts: Int, _ context: StageContext, _ part: (Int) throws -> PointCloud
  ) throws -> PointCloud {
    let size = try voxelSize(parts, context.part(from: 0, to: 0.3), part)
    let chosen = try mostConsistent(parts, size, context.part(from: 0.3, to: 0.7), part)
    var (result, next) = (PointCloud(), 0)
    for index in 0..<parts {
      try context.control.step(0.7 + 0.3 * Double(index) / Double(parts))
      let cloud = try part(index)
      while next < chosen.count, chosen[next].part == index {
        result.append(cloud, Int(chosen[next].point))
        next += 1
      }
    }
    context.notes.record("thinnedVoxel", Double(size))
    return result
  }

  /// The smallest size of which few enough voxels are occupied.
  private func voxelSize(
    _ parts: Int, _ context: StageContext, _ part: (Int) throws -> PointCloud
  ) throws -> Float {
    var sizes: [Float] = []
    var counted = [Set<UInt64>](repeating: [], count: Self.sizes)
    for index in 0..<parts {
      try context.step(index, of: parts)
      let cloud = try part(index)
      if sizes.isEmpty, let smallest = cloud.footprints.quantile(0.1), smallest > 0 {
        sizes = (0..<Self.sizes).map { smallest * pow(Self.growth, Float($0)) }
      }
      for (position, footprint) in zip(cloud.positions, cloud.footprints) where position.isFinite {
        for (k, size) in sizes.enumerated() {
          let key = VoxelKey(position, footprint: footprint, size: size)
          if key.hash % Self.countedShare == 0 { counted[k].insert(key.value) }
        }
      }
    }
    let fitting = zip(sizes, counted).first { $1.count * Int(Self.countedShare) <= maximumPoints }
    return fitting?.0 ?? sizes.last ?? 1
  }

  /// The place of a point in a cloud that is read in parts.
  private struct Place {
    var part: Int32
    var point: Int32
    var consistency: Float
  }

  /// Of each voxel the most consistent point, the first of several, in the order of the cloud.
  private func mostConsistent(
    _ parts: Int, _ size: Float, _ context: StageContext, _ part: (Int) throws -> PointCloud
  ) throws -> [Place] {
    var slots: [UInt64: Int32] = [:]
    var places: [Place] = []
    for index in 0..<parts {
      try context.step(index, of: parts)
      let cloud = try part(index)
      for i in 0..<cloud.count where cloud.positions[i].isFinite {
        let key = VoxelKey(cloud.positions[i], footprint: cloud.footprints[i], size: size)
        let place = Place(
          part: Int32(index), point: Int32(i), consistency: cloud.consistency[i])
        let slot = slots[key.value]
        if slot == nil {
          slots[key.value] = Int32(places.count)
          places.append(place)
        } else if let slot, places[Int(slot)].consistency < place.consistency {
          places[Int(slot)] = place
        }
      }
    }
    return places.sorted { ($0.part, $0.point) < ($1.part, $1.point) }
  }
}

/// A voxel of a grid whose cells are a power of two larger for coarser points.
private struct VoxelKey {
  let value: UInt64

  /// `size` is the side of the smallest voxels.
  init(_ position: SIMD3<Float>, footprint: Float, size: Float) {
    // Limit: 4 bits for the level, 20 for each coordinate; farther away, few voxels coincide.
    let level = footprint > size ? Int(min(15, log2(footprint / size).rounded(.down))) : 0
    let scaled = (position / (size * Float(1 << level))).rounded(.down)
    var value = UInt64(level)
    for axis in 0..<3 {
      let coordinate = Int64(max(-1e9, min(1e9, scaled[axis])))
      value = value << 20 | UInt64(bitPattern: coordinate) & 0xFFFFF
    }
    self.value = value
  }

  /// Bits that depend on all of the value's (SplitMix64).
  var hash: UInt64 {
    var z = value &+ 0x9E37_79B9_7F4A_7C15
    z = (z ^ z >> 30) &* 0xBF58_476D_1CE4_E5B9
    z = (z ^ z >> 27) &* 0x94D0_49BB_1331_11EB
    return z ^ z >> 31
  }
}
