import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct StructurelessPoseTests {
  private static let scene: SyntheticScene = {
    var options = SyntheticScene.Options()
    (options.photoCount, options.pointCount) = (14, 1600)
    options.pixelNoise = 0.3
    return SyntheticScene(options)
  }()
  private static let stray = 5

  /// The view graph of the scene in which the stray photo shares each point with only one other
  /// photo, and none with the tracks between the other photos.
  private static let graph: ViewGraph = {
    var graph = scene.viewGraph
    for index in graph.pairs.indices {
      let (first, second) = (
        graph.pairs[index].pair.first.index, graph.pairs[index].pair.second.index
      )
      graph.pairs[index].matches.removeAll { match in
        let point = Int(scene.pointOfFeature[first][Int(match.first)])
        // Odd points belong to the stray photo; the number of the point selects the other photo.
        guard point % 2 == 0 else { return first == stray || second == stray }
        guard first == stray || second == stray else { return true }
        let partner = [4, 6, 3, 7][point / 2 % 4]
        return first + second - stray != partner
      }
    }
    graph.pairs.removeAll { $0.matches.isEmpty }
    return graph
  }()

  @Test func poseComesFromDirections() throws {
    let pose = try #require(
      StructurelessPose().run(
        Self.stray, pairs: Self.scene.viewGraph.pairs,
        poses: Self.scene.poses.enumerated().map { $0 == Self.stray ? nil : $1 }))
    let truth = Self.scene.poses[Self.stray]
    #expect((pose.center - truth.center).length < 0.01)
    #expect((pose.rotation * truth.rotation.conjugate).angle < 0.005)
  }

  @Test func wrongPairsAreOutvoted() throws {
    var pairs = Self.scene.viewGraph.pairs
    let turn = Quaternion(angle: 0.5, axis: [0, 1, 0])
    for index in pairs.indices where pairs[index].pair.first.index == Self.stray {
      pairs[index].secondFromFirst?.rotation = turn
      break
    }
    let poses = Self.scene.poses.enumerated().map { $0 == Self.stray ? nil : $1 }
    let pose = try #require(StructurelessPose().run(Self.stray, pairs: pairs, poses: poses))
    #expect((pose.center - Self.scene.poses[Self.stray].center).length < 0.02)
  }

  @Test func onePairIsNotEnough() {
    let pairs = Self.scene.viewGraph.pairs.filter {
      $0.pair == PhotoPair(ID(Self.stray), ID(Self.stray + 1))
    }
    #expect(pairs.count == 1)
    let poses = Self.scene.poses.enumerated().map { $0 == Self.stray ? nil : $1 }
    #expect(StructurelessPose().run(Self.stray, pairs: pairs, poses: poses) == nil)
  }

  @Test func aPhotoThatSeesNoPointOfTheMapIsRegistered() throws {
    let result = try Self.scene.mapped(.incremental, graph: Self.graph)
    #expect(result.registered.count == Self.scene.options.photoCount)
    let poses = Self.scene.comparison(result)
    #expect(poses.maximumCenterError < 0.03)
    #expect(poses.maximumRotationError < 0.015)
  }
}
