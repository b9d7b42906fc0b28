import Evaluation
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Clouds of rendered scenes with exact cameras, compared with the exact surface. The thresholds
/// are slightly below the measured scores.
@Suite(.endToEnd) struct DenseSceneTests {
  /// A pixel of these photos covers 1.3 mm of the object; scores are at distances of one and two
  /// pixels.
  static let thresholds = [0.0013, 0.0026]

  static let rich = Result { try scores(.rich) }

  static func scores(_ kind: DenseScene) throws -> SurfaceScores {
    let control = KernelControl(threadCount: 2)
    let scene = kind.scene(
      width: 360, poses: DenseScene.arc(count: 7, stepDegrees: 10), fineness: 0.3)
    let reconstruction = scene.reconstruction(pointCount: 200)
    let cloud = try PointCloudGeneration().run(
      reconstruction, images: ImageStore(images: scene.photos(control)),
      StageContext(control: control, notes: StageNotes()))
    var options = SurfaceComparison.Options()
    options.thresholds = thresholds
    options.referenceSamples = 20_000
    options.floor = Floor(axis: 1, height: 0.004)
    options.threadCount = 2
    let comparison = SurfaceComparison(options)
    return try comparison.run(
      cloud, .identity,
      reference: comparison.reference(
        scene.object, cameras: NamedCamera.cameras(of: reconstruction)))
  }

  @Test func richTextureIsCoveredAccurately() throws {
    let scores = try Self.rich.get().thresholds
    #expect(scores[0].precision > 0.96)
    #expect(scores[1].precision > 0.99)
    #expect(scores[0].recall > 0.68)
    #expect(scores[1].recall > 0.75)
  }

  /// A tenth of the contrast, and less in some regions: completeness is lower, accuracy nearly
  /// equal.
  @Test func lowTextureCostsLittleAccuracy() throws {
    let (rich, low) = (try Self.rich.get(), try Self.scores(.lowTexture))
    #expect(low.thresholds[0].precision > 0.9)
    #expect(low.thresholds[1].precision > 0.98)
    #expect(low.thresholds[0].recall > 0.81 * rich.thresholds[0].recall)
    #expect(low.thresholds[1].recall > 0.88 * rich.thresholds[1].recall)
    #expect(low.accuracy < 2 * rich.accuracy)
  }

  /// Rods, a wire and leaves 1.5 to 5 pixels thick.
  @Test func thinPartsAreCoveredAccurately() throws {
    let scores = try Self.scores(.thin).thresholds
    #expect(scores[0].precision > 0.95)
    #expect(scores[1].precision > 0.985)
    #expect(scores[0].recall > 0.62)
    #expect(scores[1].recall > 0.7)
  }
}
