import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct FusedViewTests {
  private let view = FusedView(
    cloud: PointCloud(
      positions: [[1, 2, 3]], normals: [[0, 0, 1]], colors: [[4, 5, 6]], consistency: [0.5],
      footprints: [0.1], photoOffsets: [0, 2], photoIndices: [3, 7]),
    acceptedPatches: 9, pointsOutsideMasks: 2)

  @Test func bytesRestoreTheView() throws {
    let found = try #require(FusedView(encoded: view.encoded[...]))
    #expect(found.acceptedPatches == 9 && found.pointsOutsideMasks == 2)
    #expect(found.cloud.encoded() == view.cloud.encoded())
  }

  @Test func partsOfTheBytesAreRefused() {
    let bytes = view.encoded
    for count in 0..<bytes.count { #expect(FusedView(encoded: bytes.prefix(count)) == nil) }
  }
}
