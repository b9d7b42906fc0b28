import Foundation
import Kernels
import SceneModel

/// The results of a run's stages. Each is made once; alignment and surface are read from the
/// checkpoint directory if an earlier run with the same photos and options sealed them there.
///
/// Holds the lock of the checkpoint directory, and writes results there for other tools. Used on
/// the run's thread only.
final class StageCache {
  private struct AtResolution<Value> {
    /// The number of pixels per view in the dense stage.
    var viewPixels: Int
    var value: Value
  }

  let checkpoint: Checkpoint?
  /// Parts of stages that several processes make for each other; nil if none do.
  let units: UnitStore?
  private let access: CheckpointAccess
  /// Whether alignment and surface depend on the photos and options alone, so that another run may
  /// reuse them.
  private let sealsStages: Bool
  private let recorder: RunRecorder
  private var lock: DirectoryLock?

  private var photos: PhotoSet?
  private var aligned: AlignedPhotos?
  private var scene: ObjectScene?
  /// Folder of estimated masks of a run without a checkpoint directory.
  private var temporaryMasks: ScratchFolder?
  /// Folder of the dense stage, if its files are needed later, of such a run.
  private var temporaryViews: ScratchFolder?
  /// Folder of the tiles' intermediate files, of a run without a checkpoint directory, or whose
  /// cameras were given.
  private var temporaryTiles: ScratchFolder?
  private var cloud: AtResolution<PointCloud>?
  private var surface: AtResolution<Mesh>?
  private var system: AtResolution<SurfaceSystem>?

  init(
    directory: URL?, access: CheckpointAccess, sealsStages: Bool, recorder: RunRecorder
  ) {
    checkpoint = directory.map(Checkpoint.init)
    units = checkpoint?.units(isWritten: access == .parts)
    self.access = access
    self.sealsStages = sealsStages
    self.recorder = recorder
  }

  // MARK: - Lock

  /// Locks the checkpoint directory until `unlock()`; throws `CheckpointError`.
  func lockDirectory() throws {
    guard lock == nil, let checkpoint else { return }
    lock = try DirectoryLock(checkpoint.directory, isShared: access != .exclusive)
    // Others may be writing theirs.
    if access == .exclusive { checkpoint.removeRemains() }
  }

  /// Unlocks the checkpoint directory for other runs until this one continues.
  func unlock() { lock = nil }

  /// Whether results are reported: not by a part of a run, since the whole run reports them.
  var isReported: Bool { access != .parts }

  /// Writes the report, unless the directory is not locked and may be in use by another run.
  func writeReport() throws {
    guard lock != nil, isReported else { return }
    try checkpoint?.write(recorder.report)
  }

  // MARK: - Results

  /// Drops decoded photos and the cloud, which can be recomputed.
  func dropReproducible() {
    cloud = nil
    system = nil
    photos = photos?.emptied
    if let emptied = scene?.photos.emptied { scene?.photos = emptied }
  }

  /// Where results are written for other tools; nil for one of several parts of a run, which leaves
  /// only what other parts need.
  var checkpointForTools: Checkpoint? { isReported ? checkpoint : nil }

  /// Writes the reconstruction for other tools.
  func write(_ reconstruction: Reconstruction) throws {
    try checkpointForTools?.write(reconstruction)
  }

  /// The photos so far, with masks if there are any; nil before they are read.
  var currentImages: ImageStore? { (scene?.photos ?? photos)?.images }

  /// The reconstruction so far; nil before alignment.
  var currentReconstruction: Reconstruction? { aligned?.reconstruction }

  func photos(_ make: () throws -> PhotoSet) throws -> PhotoSet {
    if let photos { return photos }
    let result = try make()
    photos = result
    return result
  }

  /// The masks that alignment estimated; nil if it did not.
  var masksOfAlignment: EstimatedMasks? { aligned?.masks }

  func aligned(_ make: () throws -> AlignedPhotos) throws -> AlignedPhotos {
    if let aligned { return aligned }
    let result = try make()
    aligned = result
    return result
  }

  func scene(_ make: () throws -> ObjectScene) throws -> ObjectScene {
    if let scene { return scene }
    let result = try make()
    scene = result
    return result
  }

  /// A cloud from views of `viewPixels` pixels or more.
  func cloud(viewPixels: Int, _ make: () throws -> PointCloud) throws -> PointCloud {
    if let cloud, cloud.viewPixels >= viewPixels { return cloud.value }
    let result = try make()
    cloud = AtResolution(viewPixels: viewPixels, value: result)
    return result
  }

  /// Keeps what a surface is made from, for tiles.
  func keep(_ system: SurfaceSystem, viewPixels: Int) {
    self.system = AtResolution(viewPixels: viewPixels, value: system)
  }

  /// What the surface from views of `viewPixels` pixels was made from; nil if it isn't kept.
  func system(viewPixels: Int) -> SurfaceSystem? {
    system.flatMap { $0.viewPixels == viewPixels ? $0.value : nil }
  }

  /// A surface from views of `viewPixels` pixels or more.
  func surface(viewPixels: Int, _ make: () throws -> Mesh) throws -> Mesh {
    if let surface, surface.viewPixels >= viewPixels { return surface.value }
    let result = try make()
    surface = AtResolution(viewPixels: viewPixels, value: result)
    return result
  }
}

// MARK: - Sealed stages

extension StageCache {
  /// The alignment that an earlier run sealed, or else the result of `make`, which is then sealed.
  func sealedAlignment(
    of photos: PhotoSet, _ configuration: PipelineConfiguration, _ notes: StageNotes,
    _ make: () throws -> AlignedPhotos
  ) throws -> AlignedPhotos {
    guard let store = try store(photos, configuration) else { return try make() }
    if let found = store.alignment(of: photos.ingested.photos, notes) { return found }
    let result = try make()
    try store.save(result, notes)
    return result
  }

  /// The masks that an earlier run sealed, or else the result of `make`, which is then sealed.
  func sealedMasks(
    of photos: PhotoSet, _ configuration: PipelineConfiguration, _ context: StageContext,
    _ make: () throws -> ObjectMasking.Result?
  ) throws -> EstimatedMasks {
    let store = try store(photos, configuration)
    if let found = store?.masks(context.notes) { return found }
    let result = try EstimatedMasks(
      try make(), of: photos.ingested.photos, in: try maskFolder(), context.control)
    try store?.save(result, context.notes)
    return result
  }

  /// The folder of estimated masks.
  func maskFolder() throws -> URL {
    if let folder = checkpoint?.masks ?? temporaryMasks?.url { return folder }
    let folder = try ScratchFolder()
    temporaryMasks = folder
    return folder.url
  }

  /// A folder for the files of the dense stage that is kept for later stages.
  func viewFolder() throws -> URL {
    if let folder = checkpoint?.views ?? temporaryViews?.url { return folder }
    let folder = try ScratchFolder()
    temporaryViews = folder
    return folder.url
  }

  /// What is made of tiles.
  func tileStore(of photos: PhotoSet, _ configuration: PipelineConfiguration) throws -> TileStore {
    var inputs = Fingerprint()
    inputs.add(try RunInputs(photos, configuration).surface)
    inputs.add(try Fingerprint.content(of: configuration.tiling))
    let texturing = configuration.textureMapping
    inputs.add(texturing.occluderTriangles)
    inputs.add(try Fingerprint.content(of: texturing.observation))
    inputs.add(try Fingerprint.content(of: texturing.exposure))
    let checkpoint = sealsStages ? checkpoint : nil
    return TileStore(
      folder: try checkpoint?.tileFolder() ?? temporaryTileFolder(), isShared: checkpoint != nil,
      inputs: inputs.value)
  }

  private func temporaryTileFolder() throws -> URL {
    let folder = try temporaryTiles ?? ScratchFolder()
    temporaryTiles = folder
    return folder.url
  }

  /// The surface that an earlier run sealed, or else the result of `make`, which is then sealed.
  func sealedSurface(
    of photos: PhotoSet, _ configuration: PipelineConfiguration, _ make: () throws -> Mesh
  ) throws -> Mesh {
    let store = try store(photos, configuration)
    let found = StageNotes()
    if let mesh = store?.surface(found) {
      recorder.send(.progress(.pointCloudGeneration, fraction: 1))
      return try recorder.run(.meshGeneration) { context in
        context.notes.add(found)
        return mesh
      }
    }
    let mesh = try make()
    // Cached first, so that it serves later requests even if it can't be written.
    surface = AtResolution(
      viewPixels: configuration.pointCloudGeneration.maximumPixelsPerView, value: mesh)
    checkpoint?.removeRecord()
    try checkpoint?.write(mesh)
    try store?.sealSurface(
      recorder.notes[.meshGeneration] ?? StageNotes(),
      denseNotes: recorder.notes[.pointCloudGeneration] ?? StageNotes())
    return mesh
  }

  /// What earlier parts of the run stored of its scene; nil if there are none.
  func sceneStore(
    of photos: PhotoSet, _ configuration: PipelineConfiguration
  ) throws -> SceneStore? {
    guard sealsStages else { return nil }
    return try units.map {
      SceneStore(units: $0, inputs: try RunInputs(photos, configuration).surface)
    }
  }

  private func store(
    _ photos: PhotoSet, _ configuration: PipelineConfiguration
  ) throws -> StageStore? {
    guard sealsStages else { return nil }
    return try checkpoint.map {
      StageStore(checkpoint: $0, inputs: try RunInputs(photos, configuration))
    }
  }

  /// Writes the record of the surface in the checkpoint, from which further models can be made
  /// later.
  func writeSurfaceRecord(
    of photos: PhotoSet, _ reconstruction: Reconstruction, in folder: URL, viewPixels: Int
  ) throws {
    guard let checkpoint, let sparseHash = checkpoint.sparseHash else { return }
    try checkpoint.write(
      SurfaceRecord(
        reconstruction, of: photos.ingested, in: folder, viewPixels: viewPixels,
        sparseHash: sparseHash))
  }
}
