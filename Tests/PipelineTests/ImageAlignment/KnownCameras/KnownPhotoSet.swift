import Foundation
import ImageFiles
import Kernels
import Pipeline
import SceneModel
import TestSupport

/// A folder of photos of a ball above a floor, and their exact cameras.
struct KnownPhotoSet {
  let scene: RaycastScene
  let folder: TemporaryFolder

  /// `photos` are written; there are cameras for all views. Photos are reduced by `reduction` and
  /// stored rotated, with the orientation that rotates them upright.
  init(photos: [Int]? = nil, reduction: Double = 1, orientation: Int = 1) throws {
    var options = RaycastScene.Options()
    (options.width, options.height) = (420, 316)
    scene = RaycastScene(options)
    folder = try TemporaryFolder()
    for index in photos ?? Array(scene.views.indices) {
      let image = scene.views[index].image
      let reduced = try image.resized(
        width: Int(Double(image.width) / reduction), height: Int(Double(image.height) / reduction))
      // Rotating by the inverse orientation yields the stored photo.
      let stored = try reduced.turned(byOrientation: [6: 8, 8: 6][orientation] ?? orientation)
      var fields = ExifFields()
      fields.orientation = orientation
      try folder.write(
        ExifWriter.jpeg(try ImageCodec.encodeJPEG(stored, quality: 0.95), with: fields),
        as: "photos/photo\(index).jpg")
    }
  }

  var photoFolder: URL { folder.url.appendingPathComponent("photos") }

  /// The exact cameras, with points only if `hasPoints`.
  func cameras(hasPoints: Bool = false) -> Reconstruction {
    var cameras = scene.reconstruction
    if !hasPoints { cameras.points = [] }
    return cameras
  }

  func pipeline(
    _ cameras: KnownCameras, threads: Int = 2, checkpoint: URL? = nil
  ) -> ReconstructionPipeline {
    var configuration = PipelineConfiguration()
    configuration.threadCount = threads
    configuration.checkpointDirectory = checkpoint
    return ReconstructionPipeline(
      .photosWithCameras(in: photoFolder, cameras), configuration: configuration)
  }

  /// Distances of the dense cloud from the surface, in ascending order.
  func distances(_ cloud: PointCloud) -> [Double] {
    cloud.positions.map { scene.distance(to: SIMD3<Double>($0)) }.sorted()
  }

  /// Limits the cost of the dense stage.
  static var specification: DetailSpecification {
    var specification = DetailSpecification(.preview)
    specification.viewPixels = 40_000
    return specification
  }
}
