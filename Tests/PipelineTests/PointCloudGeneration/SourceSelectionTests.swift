import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SourceSelectionTests {
  private func scene(blurred: [Int: Int] = [:]) -> Reconstruction {
    var scene = SyntheticScene().reconstruction
    for (photo, pixels) in blurred { scene.photos[photo].sharpPixels = pixels }
    return scene
  }

  @Test func blurredPhotosAreLastAmongTheSources() throws {
    let selection = SourceSelection()
    let sharp = try selection.run(scene(), viewPixels: 100_000)
    let best = sharp[0][0]
    let sources = try selection.run(scene(blurred: [best.index: 2000]), viewPixels: 100_000)
    #expect(sources[0].first != best)
    // It has sharp sources itself.
    #expect(sources[best.index] == sharp[best.index])
  }

  /// A photo that is sharp enough for small views is as good as the others.
  @Test func detailBeyondTheViewsDoesNotCount() throws {
    let selection = SourceSelection()
    let best = try selection.run(scene(), viewPixels: 1000)[0][0]
    let sources = try selection.run(scene(blurred: [best.index: 2000]), viewPixels: 1000)
    #expect(sources[0].first == best)
  }
}
