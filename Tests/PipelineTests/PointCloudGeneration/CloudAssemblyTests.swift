import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct CloudAssemblyTests {
  /// A cloud whose values all depend on `start`; its points are visible in one to three photos.
  private func cloud(of count: Int, from start: Int) -> PointCloud {
    var cloud = PointCloud()
    for index in start..<start + count {
      let value = Float(index)
      cloud.positions.append([value, value + 0.25, value + 0.5])
      cloud.normals.append([0, value, 1])
      cloud.colors.append(SIMD3(truncatingIfNeeded: SIMD3(index, index + 1, index + 2)))
      cloud.consistency.append(value / 1000)
      cloud.footprints.append(1 / (value + 1))
      cloud.photoIndices += (0...index % 3).map { UInt16($0) }
      cloud.photoOffsets.append(UInt32(cloud.photoIndices.count))
    }
    return cloud
  }

  @Test(arguments: [1, 2]) func cloudsAreAppendedInTheirOrder(threads: Int) throws {
    let clouds = [cloud(of: 5, from: 0), PointCloud(), cloud(of: 7, from: 5)]
    let (assembly, control) = (CloudAssembly(), KernelControl(threadCount: threads))
    try assembly.append(clouds, control)
    assembly.reserveCapacity(times: 3, atMost: 20)
    try assembly.append([cloud(of: 3, from: 12)], control)
    #expect(assembly.take().encoded() == cloud(of: 15, from: 0).encoded())
    #expect(assembly.take().encoded() == PointCloud().encoded())
  }
}
