import Kernels
import Pipeline
import SceneModel
import TestSupport

/// The result of aligning a folder of rendered photos.
struct AlignedScene {
  let reconstruction: Reconstruction
  /// Errors of the poses of the rendered photos.
  let poses: PoseComparison
  let notes: StageNotes

  var warnings: [String] { notes.warnings }

  /// Renders, writes, reads and aligns the photos of a scene, together with unrelated photos.
  init(_ scene: RenderedScene, unrelatedPhotos: Int = 0, hasMetadata: Bool = true) throws {
    var scene = scene
    scene.samplesPerSide = 1
    let folder = try TemporaryFolder()
    let control = KernelControl(threadCount: 2)
    try folder.write(
      try scene.photos(control), focalLength: hasMetadata ? scene.camera.focalLength.x : nil)
    let (width, height) = (scene.camera.width, scene.camera.height)
    for index in 0..<unrelatedPhotos {
      let unrelatedPhoto = TexturePattern.image(
        width: width, height: height, seed: UInt32(7919 * index + 5))
      try folder.write(
        [unrelatedPhoto], focalLength: scene.camera.focalLength.x, first: index, prefix: "x_")
    }
    notes = StageNotes()
    let context = StageContext(control: control, notes: notes)
    let ingested = try PhotoIngestion().run(folder: folder.url, context)
    let images = ImageStore(
      photos: ingested.photos, byteBudget: 1 << 30, processingPixels: ingested.processingPixels)
    let reconstruction = try ImageAlignment().run(
      photos: ingested.photos, cameras: ingested.cameras, images: images, context)
    let estimated = scene.poses.indices.map { index in
      ingested.photos.first { $0.name == RenderedScene.name(index) }
        .flatMap { reconstruction.poses[$0.id.index] }
    }
    self.reconstruction = reconstruction
    poses = PoseComparison(estimated: estimated, true: scene.poses)
  }
}
