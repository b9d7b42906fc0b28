import Kernels
import SceneModel
import Testing

@Suite struct FreeSpaceTests {
  /// Photos and the points that each sees, with rays that end 0.1 in front of them.
  func freeSpace(
    centers: [SIMD3<Float>], points: [SIMD3<Float>], photos: [[UInt16]], threads: Int = 1
  ) throws -> FreeSpace {
    var cloud = PointCloud(positions: points)
    for photos in photos {
      cloud.photoIndices += photos
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    return try FreeSpace(
      low: [-1, -1, -1], high: [1, 1, 1], cellSize: 0.1, cloud: cloud,
      clearances: points.map { _ in 0.1 }, centers: centers, KernelControl(threadCount: threads))
  }

  @Test func cellsAlongARayAreFree() throws {
    let space = try freeSpace(
      centers: [[-3, 0.05, 0.05]], points: [[0.5, 0.05, 0.05]], photos: [[0]])
    for x in stride(from: Float(-0.95), to: 0.35, by: 0.1) {
      #expect(space.photos(at: [x, 0.05, 0.05]) == 1)
      #expect(space.photos(at: [x, 0.15, 0.05]) == 0)
    }
    #expect(space.photos(at: [0.55, 0.05, 0.05]) == 0)
    #expect(space.photos(at: [-2, 0.05, 0.05]) == 0)
  }

  @Test func photosCountOncePerCell() throws {
    let centers: [SIMD3<Float>] = [[-3, 0, 0], [3, 0.01, 0], [0, -3, 0.01]]
    let points: [SIMD3<Float>] = [[0.9, 0, 0], [0.9, 0.01, 0.01], [-0.9, 0, 0], [0, 0.9, 0]]
    let space = try freeSpace(
      centers: centers, points: points, photos: [[0], [0], [1], [2]])
    #expect(space.photos(at: [0.01, 0.01, 0.01]) == 3)
    #expect(space.photos(at: [0.55, 0.01, 0.01]) == 2)
  }

  /// Compared with points sampled along the rays, in cells in any direction.
  @Test(arguments: [1, 3]) func raysCrossTheCellsOfTheirPoints(threads: Int) throws {
    var random = SplitMix64(seed: 7)
    let place = { (random: inout SplitMix64, size: Float) in
      let at = { (r: inout SplitMix64) in Float(r.below(1 << 20)) / Float(1 << 19) - 1 }
      return SIMD3<Float>(at(&random), at(&random), at(&random)) * size
    }
    let centers = (0..<40).map { _ in place(&random, 3) }
    let points = (0..<40).map { _ in place(&random, 1) }
    let space = try freeSpace(
      centers: centers, points: points, photos: (0..<40).map { [$0] }, threads: threads)
    for (center, point) in zip(centers, points) {
      let free = 1 - 0.1 / (point - center).length
      for step in 0..<100 {
        let at = center + (point - center) * (free * (Float(step) + 0.5) / 100)
        if at.max() < 1, at.min() > -1 { #expect(space.photos(at: at) >= 1) }
      }
    }
  }

  @Test func nonFinitePointsAreIgnored() throws {
    let space = try freeSpace(
      centers: [[-3, 0, 0], [.nan, 0, 0]], points: [[.nan, 0, 0], [0, .infinity, 0], [0, 0, 0]],
      photos: [[0], [0], [1]])
    #expect(space.photos(at: [0, 0, 0]) == 0)
    #expect(throws: KernelError.self) {
      try freeSpace(centers: [[-3, 0, 0]], points: [[0, 0, 0]], photos: [[4]])
    }
  }
}
