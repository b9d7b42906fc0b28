import Foundation
import ImageFiles
import Kernels
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// Alignment of photos with masks.
@Suite(.endToEnd, .serialized) struct MaskedAlignmentTests {
  @Test func featuresAreInsideTheMask() throws {
    let image = TexturePattern.image(width: 640, height: 480, seed: 3)
    var mask = RasterImage(width: 640, height: 480, channels: 1)
    for y in 100..<300 { for x in 200..<400 { mask.pixels[y * 640 + x] = 255 } }
    let photos = FeatureExtractionTests.photos(of: [image, image])
    let sets = try FeatureExtraction().run(
      photos, images: ImageStore(images: [image, image], masks: [mask, nil]), StageContext())
    #expect(sets[0].count > 50)
    #expect(sets[1].positions.contains { $0.x < 150 })
    let margin: Float = 3
    #expect(
      sets[0].positions.allSatisfy {
        $0.x > 200 - margin && $0.x < 400 + margin && $0.y > 100 - margin && $0.y < 300 + margin
      })
  }

  /// The background indicates a static camera: masks exclude it, or else its lack of motion.
  @Test func turntableIsAlignedByTheObject() throws {
    var scene = RenderedScene.statue(photoCount: 20, upperCount: 0, width: 480, height: 360)
    scene.samplesPerSide = 1
    let control = KernelControl(threadCount: 2)
    let turntable = try TurntablePhotos(scene, control)
    let folder = try TemporaryFolder()
    try folder.write(turntable.photos, focalLength: scene.camera.focalLength.x)
    for (index, mask) in turntable.masks.enumerated() {
      try folder.write(ImageCodec.encodePNG(mask), as: "masks/\(RenderedScene.name(index)).png")
    }
    var configuration = PipelineConfiguration()
    configuration.alignment.ordering = .sequential
    let aligned = try ReconstructionPipeline(
      .photos(in: folder.url), configuration: configuration
    ).align()
    #expect(aligned.registered.count == 20)
    let poses = PoseComparison(estimated: aligned.poses, true: scene.poses)
    #expect(poses.maximumCenterError < 0.01)

    try FileManager.default.removeItem(at: folder.url.appendingPathComponent("masks"))
    let unmasked = try ReconstructionPipeline(
      .photos(in: folder.url), configuration: configuration
    ).align()
    #expect(unmasked.registered.count == 20)
    let others = PoseComparison(estimated: unmasked.poses, true: scene.poses)
    #expect(others.maximumCenterError < 0.01)

    configuration.isObjectMaskingEnabled = false
    #expect(throws: PipelineError.self) {
      try ReconstructionPipeline(.photos(in: folder.url), configuration: configuration).align()
    }
  }
}
