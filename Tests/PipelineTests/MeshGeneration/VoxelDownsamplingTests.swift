import SceneModel
import Testing

@testable import Pipeline

@Suite struct VoxelDownsamplingTests {
  private let cloud: PointCloud = {
    var random = SplitMix64(seed: 5)
    var cloud = PointCloud()
    for index in 0..<2000 {
      let (x, y, z) = (random.uniform(), random.uniform(), random.uniform())
      cloud.positions.append([Float(x), Float(y), Float(z)])
      cloud.normals.append([0, 0, 1])
      cloud.colors.append([UInt8(index % 256), 0, 0])
      cloud.consistency.append(Float(random.uniform()))
      cloud.footprints.append(Float(0.05 + 0.3 * random.uniform()))
      cloud.photoIndices += [UInt16(index % 7), UInt16(7 + index % 5)]
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    return cloud
  }()

  @Test func pointsThatAreNotKeptHaveNoInfluence() throws {
    let isKept = cloud.footprints.indices.map { $0 % 3 != 1 }
    let some = try VoxelDownsampling().run(cloud, keeping: isKept, StageContext())
    let expected = try VoxelDownsampling().run(cloud.filtered(by: isKept), StageContext())
    #expect(some.voxelSize == expected.voxelSize && some.weights == expected.weights)
    #expect(some.cloud.positions == expected.cloud.positions)
    #expect(some.cloud.photoIndices == expected.cloud.photoIndices)
    #expect(zip(some.sampleOfPoint, isKept).allSatisfy { ($0 >= 0) == $1 })
    #expect(some.cloud.count < 1000)
  }

  @Test func nothingKeptIsNoSurface() {
    #expect(throws: PipelineError.self) {
      try VoxelDownsampling().run(
        cloud, keeping: cloud.footprints.map { _ in false }, StageContext())
    }
  }
}
