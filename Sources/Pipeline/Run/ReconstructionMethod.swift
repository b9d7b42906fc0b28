import Foundation
import Kernels
import SceneModel

/// The method, from photos to a model file, for one detail level.
///
/// Each step takes the results of the preceding steps and returns a new result. The recorder
/// measures it, and the cache returns the result of an earlier call or run if there is one.
struct ReconstructionMethod {
  let source: RunSource
  /// Specialized for the detail level.
  let configuration: PipelineConfiguration
  let cache: StageCache
  let recorder: RunRecorder
  /// Nil if nobody wants the page of a report.
  let collector: MaterialCollector?

  /// The number of pixels per view in the dense stage.
  var viewPixels: Int { configuration.pointCloudGeneration.maximumPixelsPerView }

  /// Runs all steps, from the photos to the file. The model contains the part of the surface inside
  /// the crop box, moved by the transform. Writes the scene in `tiles`, too.
  func writeModel(in geometry: ModelGeometry, to url: URL, tiles: TileOutput? = nil) throws {
    let photos = try ingest()
    let reconstruction = try align(photos)
    let scene = try maskObject(photos, reconstruction)
    let surface = try surface(scene)
    let model = try texture(surface, scene, inside: geometry.crop)
    let tiles = try tiles.map { try tileInput(scene, in: geometry, to: $0) }
    try recorder.run(.optimization, images: tiles.map { _ in photos.images }) { context in
      let end = tiles == nil ? 1 : 0.05
      try export(
        model, reconstruction, movedBy: geometry.transform, to: url,
        context.part(from: 0, to: end))
      guard let tiles else { return }
      try context.notes.step("tiles") { try writeTiles(tiles, context.part(from: end, to: 1)) }
    }
  }

  /// Reads and validates the photos.
  func ingest() throws -> PhotoSet {
    try recorder.recordingErrors { try cache.lockDirectory() }
    return try cache.photos {
      let ingested = try recorder.run(.preProcessing) {
        try source.ingest(configuration, cache.units, $0)
      }
      collector?.add(ingested)
      try recorder.record(
        ingested, folder: source.photoFolder,
        minimumPhotos: configuration.alignment.minimumPhotos)
      return PhotoSet(ingested, readings: source.readings, byteBudget: configuration.imageMemory)
    }
  }

  /// Estimates cameras, poses and sparse points in the frame that all results share.
  func align(_ photos: PhotoSet) throws -> Reconstruction {
    try cache.aligned {
      let result = try source.cameras(of: photos, configuration, cache, recorder)
      if cache.isReported { recorder.record(result.reconstruction) }
      // Given cameras may have been read from the checkpoint.
      if source.isPhotosOnly { try cache.write(result.reconstruction) }
      return result
    }.reconstruction
  }

  /// Estimates masks if the photos have none, of the object if it is to be isolated, otherwise of
  /// all but the sky, and writes the masks in use if configured.
  func maskObject(_ photos: PhotoSet, _ reconstruction: Reconstruction) throws -> ObjectScene {
    let areMasksNeeded = source.isPhotosOnly && !photos.images.hasMasks
    guard areMasksNeeded || configuration.maskOutput != nil else {
      return ObjectScene(photos, reconstruction)
    }
    return try cache.scene {
      try recorder.run(.objectMasking, images: photos.images) { context in
        let scene =
          areMasksNeeded
          ? try estimatedScene(photos, reconstruction, context)
          : ObjectScene(photos, reconstruction)
        try configuration.maskOutput.map { try MaskOutput(folder: $0).write(scene.photos, context) }
        return scene
      }
    }
  }

  /// The photos with estimated masks, or without masks if there is no separate object or no sky.
  private func estimatedScene(
    _ photos: PhotoSet, _ reconstruction: Reconstruction, _ context: StageContext
  ) throws -> ObjectScene {
    let masks =
      try cache.masksOfAlignment
      ?? cache.sealedMasks(of: photos, configuration, context) {
        try configuration.isObjectMaskingEnabled
          ? ObjectMasking(options: configuration.objectMasking)
            .run(reconstruction, images: photos.images, context)
          : SkyDetection(options: configuration.sky)
            .run(reconstruction, images: photos.images, context)
      }
    recorder.record(masks, names: photos.ingested.photos.map(\.name))
    return masks.isEmpty
      ? ObjectScene(photos, reconstruction) : ObjectScene(photos, reconstruction, masks)
  }

  /// Makes the oriented, colored point cloud; `views` are those of the dense stage, if they are
  /// known.
  func densify(_ scene: ObjectScene, _ views: DenseViews? = nil) throws -> PointCloud {
    let (photos, reconstruction) = (scene.photos, scene.reconstruction)
    return try cache.cloud(viewPixels: viewPixels) {
      try recorder.run(.pointCloudGeneration, images: photos.images) { context in
        let cloud = try cloud(scene, views, context)
        collector?.add(cloud)
        let end = context.part(from: 1, to: 1)
        try beside(
          { [checkpoint = cache.checkpointForTools] in try checkpoint?.write(cloud) }, end.control
        ) {
          try CloudMetrics().run(cloud, reconstruction, end)
        }
        return cloud
      }
    }
  }

  private func cloud(
    _ scene: ObjectScene, _ views: DenseViews?, _ context: StageContext
  ) throws -> PointCloud {
    let (generation, images) = (
      PointCloudGeneration(options: configuration.pointCloudGeneration), scene.photos.images
    )
    let folder = try configuration.tiles == nil ? cache.checkpoint?.views : cache.viewFolder()
    guard let views else {
      return try generation.run(scene.reconstruction, images: images, folder: folder, context)
    }
    return try generation.run(views, scene.reconstruction, images: images, folder: folder, context)
  }

  /// Makes the unsimplified surface of the object, or of the whole scene if masking is off.
  func surface(_ scene: ObjectScene) throws -> Mesh {
    try cache.surface(viewPixels: viewPixels) {
      if case .savedRun(let saved) = source { return saved.surface(viewPixels, recorder) }
      let surface = try cache.sealedSurface(of: scene.photos, configuration) {
        try meshOfStoredSamples(scene) ?? mesh(try densify(scene), scene)
      }
      try cache.writeSurfaceRecord(
        of: scene.photos, scene.reconstruction, in: source.photoFolder, viewPixels: viewPixels)
      return surface
    }
  }

  /// Meshes the cloud.
  private func mesh(_ cloud: PointCloud, _ scene: ObjectScene) throws -> Mesh {
    try mesh(scene) { meshing, silhouettes, context in
      try meshing.run(
        cloud, scene.reconstruction, silhouettes: silhouettes, support: scene.support,
        surroundings: scene.surroundings, context
      ) {
        if configuration.tiles != nil { cache.keep($0, viewPixels: viewPixels) }
      }
    }
  }

  /// Makes a mesh, and refines it if configured, which takes three fifths of the stage.
  func mesh(
    _ scene: ObjectScene, _ make: (MeshGeneration, Silhouettes?, StageContext) throws -> Mesh
  ) throws -> Mesh {
    let (images, reconstruction) = (scene.photos.images, scene.reconstruction)
    return try recorder.run(.meshGeneration, images: images) { context in
      let share = configuration.photoRefinement == nil ? 1 : 0.4
      let mesh = try make(
        MeshGeneration(configuration.meshGeneration),
        try Silhouettes(reconstruction, images: images), context.part(from: 0, to: share))
      guard let refinement = configuration.photoRefinement else { return mesh }
      return try PhotoRefinement(options: refinement).run(
        mesh, source: ViewSource(reconstruction, images: images), context.part(from: share, to: 1))
    }
  }

  /// Simplifies the surface inside a box to the triangle budget, and textures it.
  func texture(
    _ surface: Mesh, _ scene: ObjectScene, inside box: OrientedBox?
  ) throws -> TexturedMesh {
    let (photos, reconstruction) = (scene.photos, scene.reconstruction)
    return try recorder.run(.textureMapping, images: photos.images) { context in
      let parts = box.map { MeshCropping(box: $0).run(surface) }
      let dense = parts?.inside ?? surface
      guard !dense.triangles.isEmpty else { throw PipelineError.emptyCrop }
      let mesh = try context.notes.step("simplification") {
        try Simplification(options: configuration.simplification)
          .run(dense, context.part(from: 0, to: 0.15))
      }
      var texturing = TextureMapping(options: configuration.textureMapping)
      if !configuration.isObjectMaskingEnabled { texturing.options.presence = nil }
      return try texturing.run(
        mesh, dense: dense, occluders: parts?.outside ?? Mesh(), reconstruction: reconstruction,
        images: photos.images, context.part(from: 0.15, to: 1)
      ) { evidence in
        try context.notes.step("review") { try review(evidence, of: scene, context.control) }
      }
    }
  }

  /// Records how the photos show the surface, and what photos are missing. Without masks, the
  /// surface ends where the photos do, so that its rim indicates nothing.
  private func review(
    _ evidence: ModelEvidence, of scene: ObjectScene, _ control: KernelControl
  ) throws {
    let control = control.part(from: 0, to: 0)
    let (images, reconstruction) = (scene.photos.images, scene.reconstruction)
    var statistics = SurfaceStatistics(
      evidence, residual: reconstruction.meanReprojectionError)
    var advice: [Advice] = []
    if configuration.isObjectMaskingEnabled, images.hasMasks {
      statistics.outlineShare = try OutlineCoverage()
        .run(evidence, reconstruction, images: images, control)
      let found = try SurfaceAdvice(evidence, reconstruction, control)
      statistics.missingShare = found?.missingShare
      advice = found?.advice ?? []
    }
    recorder.record(evidence, statistics, advice)
    try collector?.add(evidence, reconstruction, control)
  }

  /// Writes the model in the format of the URL's extension, and renders a preview if configured.
  func export(
    _ model: TexturedMesh, _ reconstruction: Reconstruction, movedBy transform: AffineMap,
    to url: URL, _ context: StageContext
  ) throws {
    let end = configuration.previewFile == nil ? 1 : 0.7
    let faces =
      switch configuration.meshPrimitive {
      case .triangle: model
      case .quad: try QuadPairing().run(model, context.part(from: 0, to: 0))
      }
    try context.notes.step("export") {
      try ModelExport(options: configuration.export)
        .run(faces.transformed(by: transform), to: url, context.part(from: 0, to: end))
    }
    if let collector {
      try context.notes.step("report") {
        try collector.add(model, reconstruction, context.part(from: end, to: end))
      }
    }
    guard let preview = configuration.previewFile else { return }
    // The preview is rendered in the frame of the cameras.
    try ModelPreview(configuration.preview).write(
      model, cameras: reconstruction.poses.compactMap { $0 }, to: preview,
      context.part(from: end, to: 1))
  }
}
