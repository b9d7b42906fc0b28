import Kernels
import SceneModel

/// Keeps what the page of a report shows, as a run makes it. Used on the run's thread only.
final class MaterialCollector {
  private var ingested: IngestedPhotos?
  private var figures: [VertexFigures] = []
  private var model: PageModel?
  private var pictures: String?
  private var dense: PagePoints?

  func add(_ ingested: IngestedPhotos) { self.ingested = ingested }

  func add(_ cloud: PointCloud) { dense = PagePoints(cloud.positions, cloud.colors) }

  /// Keeps the figures of a surface until its model is added.
  func add(
    _ evidence: ModelEvidence, _ reconstruction: Reconstruction, _ control: KernelControl
  ) throws {
    figures = try VertexFigures.all(evidence, reconstruction, control)
  }

  /// `model` is in the frame of the cameras, and the one whose evidence was added last.
  func add(
    _ model: TexturedMesh, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws {
    self.model = try PageModel(model, figures, context.part(from: 0, to: 0))
    figures = []
    var preview = ModelPreview.Options()
    preview.tileSide = Self.pictureSide
    let overview = try ModelPreview(preview)
      .run(
        try Self.withSmallTextures(model), cameras: reconstruction.poses.compactMap { $0 }, context)
    pictures = try overview.dataURL(quality: Self.pictureQuality)
  }

  /// The model with a color texture of at most `previewTexture` texels per side, which takes a
  /// quarter of the time to filter.
  private static func withSmallTextures(_ model: TexturedMesh) throws -> TexturedMesh {
    var result = model
    for index in result.atlases.indices {
      let color = try result.atlases[index].maps[.diffuseColor]?.fitted(to: previewTexture)
      result.atlases[index].maps = color.map { [.diffuseColor: $0] } ?? [:]
    }
    return result
  }

  /// Chosen: three times the texels that a picture of `pictureSide` shows.
  private static let previewTexture = 1024

  /// Of one of the eight pictures, in pixels. Chosen: they are shown where a browser can't draw the
  /// model.
  private static let pictureSide = 320
  private static let pictureQuality: Float = 0.85

  /// What was collected, with the pictures of photos; `images` have masks if there are any.
  func material(
    names: [String], images: ImageStore?, _ reconstruction: Reconstruction?,
    _ control: KernelControl
  ) throws -> ReportMaterial {
    var result = ReportMaterial()
    (result.model, result.pictures, result.points.dense) = (model, pictures, dense)
    if let reconstruction {
      result.points.sparse = PagePoints(
        reconstruction.points.map { SIMD3<Float>($0.position) },
        reconstruction.points.map(\.color))
    }
    if let ingested {
      let images = images ?? ImageStore(photos: ingested.photos)
      result.photos = try ReportPictures(
        ingested: ingested, images: images, reconstruction: reconstruction
      ).run(names: names, control)
    }
    return result
  }
}
