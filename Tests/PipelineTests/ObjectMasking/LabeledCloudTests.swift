import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct LabeledCloudTests {
  /// All discs of a cloud, wherever its points come from, are transformed.
  @Test func allPartsAreTransformed() {
    let part = PointCloud(
      positions: [[1, 2, 3]], normals: [[0, 0, 1]], colors: [[1, 2, 3]], consistency: [1],
      footprints: [0.5], photoOffsets: [0, 1], photoIndices: [0])
    let cloud = LabeledCloud(
      cloud: part, isObject: [true], isRigid: false,
      partialSurroundings: [(photos: [0], cloud: part)])
    let turn = Quaternion(angle: .pi / 2, axis: [0, 1, 0])
    let moved = cloud.transformed(
      by: SimilarityTransform(scale: 2, rotation: turn, translation: [10, 0, 0]))
    let discs = moved.discs(in: ID(0), radius: 3)
    #expect(discs.labels == [PointLabel.object, PointLabel.surroundings])
    #expect(discs.radii == [3, 3])
    for position in discs.positions { #expect((position - [16, 4, -2]).length < 1e-5) }
    for cloud in [moved.cloud, moved.partialSurroundings[0].cloud] {
      #expect((cloud.normals[0] - [1, 0, 0]).length < 1e-6)
    }
    #expect(moved.partialSurroundings[0].photos == [0])
  }
}
