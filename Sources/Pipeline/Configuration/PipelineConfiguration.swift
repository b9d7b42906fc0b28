import Foundation
import SceneModel

/// The configuration of a run: the options of each stage, the output files and the threads.
///
/// Options that depend on the detail level of a model are undefined until
/// `specialized(for:viewPixels:)` sets them.
package struct PipelineConfiguration: Hashable, Codable, Sendable {
  package var ingestion = PhotoIngestion.Options()
  package var alignment = ImageAlignment.Options()
  var objectMasking = ObjectMasking.Options()
  var sky = SkyDetection.Options()
  var movedObjects = MovedObjectAlignment.Options()
  package var pointCloudGeneration = PointCloudGeneration.Options()
  package var meshGeneration = MeshGeneration.Options()
  /// Fits the surface to the photos at a higher resolution than the dense stage's; nil keeps the
  /// surface as meshing returns it.
  package var photoRefinement: PhotoRefinement.Options?
  package var simplification = Simplification.Options()
  package var textureMapping = TextureMapping.Options()
  package var tiling = Tiling.Options()
  package var export = ModelExport.Options()
  package var preview = ModelPreview.Options()

  /// The mesh primitive in model files, if the format supports several.
  package var meshPrimitive = MeshPrimitive.triangle
  /// Folder for intermediate results; nil writes none.
  package var checkpointDirectory: URL?
  /// Folder for the masks of the object as PNG files; nil writes none.
  package var maskOutput: URL?
  /// The PNG file of a preview that shows each model from several sides; nil renders none.
  package var previewFile: URL?
  /// Where the scene is written in tiles of full detail, too; nil makes none.
  package var tiles: TileOutput?
  /// Whether pictures, the model and points are kept for the page of a report.
  package var keepsReportMaterial = false
  /// The number of threads of all stages; does not affect the results.
  package var threadCount: Int = ProcessorShare.current.threads

  /// The defaults, within the limits of a machine: every configuration of a session or a command
  /// starts from them.
  package init(machine: Machine = .current) {
    let limits = machine.limits
    ingestion.maximumPhotos = limits.maximumPhotos
    ingestion.inspection.limits.maximumSide = limits.maximumPhotoSide
    ingestion.memoryBudget = limits.imageMemory
    meshGeneration.poisson.maximumBytes = limits.surfaceMemory
    pointCloudGeneration.maximumPoints = limits.cloudPoints
  }
}

extension PipelineConfiguration {
  /// Whether to isolate the object from its support and background, using the photos' masks if
  /// there are any.
  package var isObjectMaskingEnabled: Bool {
    get { meshGeneration.isolatesObject }
    set {
      ingestion.inspection.usesMasks = newValue
      objectMasking.isEnabled = newValue
      meshGeneration.isolatesObject = newValue
    }
  }

  /// Whether alignment has to find the object: masks are to be estimated, and none are given.
  func findsObject(in photos: ImageStore) -> Bool { objectMasking.isEnabled && !photos.hasMasks }

  /// The options of alignment for some photos.
  package func alignmentOptions(for photos: ImageStore) -> ImageAlignment.Options {
    var options = alignment
    // Given masks exclude the surroundings; without masking, these are as good as the object.
    options.correspondences.secondMotions.isEnabled = findsObject(in: photos)
    return options
  }

  /// Bytes that decoded photos may occupy, in the image store and while one is processed.
  package var imageMemory: Int { ingestion.memoryBudget }

  /// The options for a model of `specification`, whose surface is made from views of `viewPixels`
  /// pixels: at least the specification's, more if a finer model shares the surface.
  package func specialized(
    for specification: DetailSpecification, viewPixels: Int
  ) -> PipelineConfiguration {
    var result = self
    result.pointCloudGeneration.maximumPixelsPerView = viewPixels
    result.meshGeneration.adapt(toViewPixels: viewPixels)
    result.photoRefinement?.adapt(toViewPixels: viewPixels)
    result.simplification.maximumTriangles = specification.maximumTriangles
    result.textureMapping.textureSide = specification.textureSide
    result.textureMapping.maximumAtlases = specification.maximumAtlases
    result.textureMapping.maps = specification.maps
    result.export.textureFormat = specification.textureFormat
    result.export.maximumBytes = specification.maximumBytes
    return result
  }
}
