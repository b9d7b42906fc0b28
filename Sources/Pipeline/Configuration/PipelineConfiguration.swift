import Foundation
import SceneModel

/// Configuration of a run: the options of each stage, and where and how it works.
///
/// Options that follow the detail level of a model have no meaning here until `specialized(for:)`
/// sets them.
package struct PipelineConfiguration: Hashable, Codable, Sendable {
  package var ingestion = PhotoIngestion.Options()
  package var alignment = ImageAlignment.Options()
  package var pointCloudGeneration = PointCloudGeneration.Options()
  package var meshGeneration = MeshGeneration.Options()
  /// Fits the surface to the photos at a finer resolution than the dense stage's; nil leaves it as
  /// meshing returns it.
  package var photoRefinement: PhotoRefinement.Options?
  package var simplification = Simplification.Options()
  package var textureMapping = TextureMapping.Options()
  package var export = ModelExport.Options()
  package var preview = ModelPreview.Options()

  /// The faces of model files, where the format has a choice.
  package var meshPrimitive = MeshPrimitive.triangle
  /// Folder for intermediate results; nil writes none.
  package var checkpointDirectory: URL?
  /// A PNG file that shows each model from several sides; nil draws none.
  package var previewFile: URL?
  /// Threads of all stages. Results do not depend on it.
  package var threadCount: Int = ProcessInfo.processInfo.activeProcessorCount

  /// The defaults, within the limits of a machine: every configuration of a session and of a command
  /// begins here.
  package init(machine: Machine = .current) {
    let limits = machine.limits
    ingestion.maximumPhotos = limits.maximumPhotos
    ingestion.inspection.limits.maximumSide = limits.maximumPhotoSide
    ingestion.memoryBudget = limits.imageMemory
  }
}

extension PipelineConfiguration {
  /// Isolates the object from its support and background, by the photos' masks where there are some.
  package var isObjectMaskingEnabled: Bool {
    get { meshGeneration.isolatesObject }
    set {
      ingestion.inspection.usesMasks = newValue
      meshGeneration.isolatesObject = newValue
    }
  }

  /// Bytes that decoded photos may occupy, in the image store and while one is processed.
  package var imageMemory: Int { ingestion.memoryBudget }

  /// The options for a model of `specification`, whose surface is made from views of `viewPixels`
  /// pixels: at least the specification's, more where a finer model shares the surface.
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
    return result
  }
}
