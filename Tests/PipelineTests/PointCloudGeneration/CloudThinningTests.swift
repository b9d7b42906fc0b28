import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct CloudThinningTests {
  /// Parts with points on a plane, seen from near for x < 0, where they are ten times as dense, and
  /// from afar for x > 0.
  private static let parts: [PointCloud] = {
    var random = SeededGenerator(seed: 1)
    return (0..<10).map { part in
      var cloud = PointCloud()
      for index in 0..<10_000 {
        let isNear = index % 100 != 0
        let x = Float(random.uniform()) * (isNear ? -1 : 1)
        cloud.positions.append([x, Float(random.uniform()), 0])
        cloud.normals.append([0, 0, 1])
        cloud.colors.append([UInt8(part), 0, 0])
        cloud.consistency.append(Float(random.uniform()))
        cloud.footprints.append(isNear ? 0.004 : 0.04)
        cloud.photoIndices.append(UInt16(part))
        cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
      }
      return cloud
    }
  }()

  private func thinned(_ maximum: Int) throws -> PointCloud {
    try CloudThinning(maximumPoints: maximum)
      .run(parts: Self.parts.count, StageContext()) { Self.parts[$0] }
  }

  @Test(arguments: [3000, 10_000, 30_000]) func atMostThatNumberRemains(maximum: Int) throws {
    let cloud = try thinned(maximum)
    // The numbers of voxels are estimated.
    #expect(cloud.count < maximum * 11 / 10 && cloud.count > maximum / 2)
    #expect(cloud.normals.count == cloud.count && cloud.photoOffsets.count == cloud.count + 1)
  }

  @Test func pointsSeenFromAfarRemain() throws {
    let all = Self.parts.reduce(into: PointCloud()) { $0.append($1) }
    let cloud = try thinned(10_000)
    let (before, after) = (all.positions.count { $0.x > 0 }, cloud.positions.count { $0.x > 0 })
    #expect(Double(after) > 0.5 * Double(before))
    #expect(cloud.positions.count { $0.x < 0 } < all.positions.count { $0.x < 0 } / 5)
  }

  @Test func theMostConsistentPointsRemainInTheirOrder() throws {
    let cloud = try thinned(10_000)
    #expect(cloud.consistency.reduce(0, +) / Float(cloud.count) > 0.8)
    #expect(cloud.photoIndices == cloud.photoIndices.sorted())
    // Evenly: each cell of a coarse grid has some.
    let near = cloud.positions.filter { $0.x < 0 }
    #expect(Set(near.map { SIMD2(Int($0.x * -20), Int($0.y * 20)) }).count == 400)
  }

  @Test func pointsThatAreNotFiniteAreDropped() throws {
    var cloud = Self.parts[0]
    cloud.positions[5] = [.nan, 0, 0]
    cloud.positions[6] = [.infinity, 0, 0]
    cloud.footprints[7] = .infinity
    let result = try CloudThinning(maximumPoints: 1000).run(parts: 1, StageContext()) { _ in cloud }
    #expect(result.count > 0 && result.positions.allSatisfy(\.isFinite))
  }
}
