import Foundation
import SceneModel
import TestSupport
import Testing

@Suite struct SyntheticSceneTests {
  @Test(arguments: SyntheticScene.Layout.allCases)
  func observationsProjectOntoTheirFeatures(layout: SyntheticScene.Layout) {
    var options = SyntheticScene.Options()
    options.layout = layout
    let scene = SyntheticScene(options)
    #expect(scene.reconstruction.meanReprojectionError < 1e-3)
    #expect(scene.reconstruction.points.count > 300)
    #expect(scene.viewGraph.pairs.count >= options.photoCount)
    let repeated = SyntheticScene(options)
    #expect(repeated.viewGraph.pairs == scene.viewGraph.pairs)
  }

  @Test func similarityIsFoundFromPoints() throws {
    var random = SeededGenerator(seed: 5)
    for _ in 0..<50 {
      let truth = SimilarityTransform(
        scale: 0.1 + 3 * random.uniform(),
        rotation: Quaternion(angle: 4 * random.uniform(), axis: random.normal3()),
        translation: random.normal3())
      let source = (0..<5).map { _ in random.normal3() }
      let found = try #require(
        SimilarityTransform.fitting(source, to: source.map { truth * $0 }))
      #expect(abs(found.scale - truth.scale) < 1e-9)
      #expect((found.translation - truth.translation).length < 1e-9)
      #expect((found.rotation * truth.rotation.conjugate).angle < 1e-7)
    }
    #expect(SimilarityTransform.fitting([], to: []) == nil)
    #expect(
      SimilarityTransform.fitting(
        [[1, 1, 1], [1, 1, 1], [1, 1, 1]], to: [[0, 0, 0], [1, 0, 0], [0, 1, 0]]) == nil)
  }
}
