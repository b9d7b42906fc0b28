import Foundation
import Kernels
import SceneModel

/// The textured models of a scene's tiles, each in a file.
struct TileModels {
  let surfaces: TileSurfaces
  /// Nil if no model is made.
  let surroundings: TileSurroundings?
  let scene: ObjectScene
  let output: TileOutput
  /// The models contain the part of the surface inside its crop box, moved by its transform.
  let geometry: ModelGeometry
  let texturing: TextureMapping
  let export: ModelExport
  /// The fingerprint of everything that models depend on and surfaces don't.
  private let options: UInt64

  init(
    _ surfaces: TileSurfaces, _ surroundings: TileSurroundings?, _ scene: ObjectScene,
    in geometry: ModelGeometry, to output: TileOutput, _ configuration: PipelineConfiguration
  ) throws {
    (self.surfaces, self.surroundings, self.scene) = (surfaces, surroundings, scene)
    (self.geometry, self.output) = (geometry, output)
    var texturing = configuration.textureMapping
    texturing.presence = nil
    texturing.textureSide = configuration.tiling.textureSide
    texturing.maximumAtlases = configuration.tiling.maximumAtlases
    texturing.maps = [.diffuseColor]
    self.texturing = TextureMapping(options: texturing)
    export = ModelExport(options: configuration.export)
    var key = Fingerprint()
    key.add(try Fingerprint.content(of: texturing))
    key.add(try Fingerprint.content(of: configuration.export))
    key.add(output.fileExtension.utf8)
    key.add(geometry)
    options = key.value
  }

  /// Writes a tile, unless that was done; returns what the index lists, nil if it has no surface.
  @discardableResult
  func write(_ tile: Int, _ context: StageContext) throws -> TileIndex.Tile? {
    if let found = Self.written(tile, surfaces.store, in: output.folder, options) {
      return found.tile
    }
    let url = output.file(tile + 1)
    var written = WrittenTile()
    if let model = try model(tile, context) {
      try export.run(model.mesh, to: url, context.part(from: 1, to: 1))
      written.tile = TileIndex.Tile(model.mesh.mesh, photos: model.photos, url)
      written.hash = WrittenTile.hash(of: url) ?? 0
    }
    try surfaces.store.save(written, tile, options: options)
    return written.tile
  }

  /// Removes the index and the tiles of earlier runs, but for those that are as this one would
  /// write them; returns these, nil for each of the others. Throws `OutputError`.
  func prepare(_ control: KernelControl) throws -> [WrittenTile?] {
    let kept = try control.parallelMap(surfaces.count) {
      [store = surfaces.store, output, options] in
      Self.written($0, store, in: output.folder, options)
    }
    try output.prepare(keeping: Set(kept.compactMap { $0?.tile?.file }))
    return kept
  }

  private static func written(
    _ tile: Int, _ store: TileStore, in folder: URL, _ options: UInt64
  ) -> WrittenTile? {
    let found = store.written(tile, options: options)
    return found?.isIntact(in: folder) == true ? found : nil
  }

  /// The textured model of a tile, and the number of photos that show it; nil if it has no surface.
  private func model(
    _ tile: Int, _ context: StageContext
  ) throws -> (mesh: TexturedMesh, photos: Int)? {
    guard let surroundings else {
      throw KernelError.invalidArgument("models of tiles need what lies around them")
    }
    let found = try surfaces.surface(
      tile, observed: surroundings.observed, context.part(from: 0, to: 0.3))
    guard let (surface, photos) = found else { return nil }
    let mesh = geometry.crop.map { MeshCropping(box: $0).run(surface).inside } ?? surface
    guard !mesh.triangles.isEmpty, let bounds = mesh.bounds else { return nil }
    var reconstruction = scene.reconstruction
    for photo in reconstruction.poses.indices
    where UInt16(exactly: photo).map(photos.contains) != true {
      reconstruction.poses[photo] = nil
    }
    let around = MeshCropping(box: OrientedBox(min: bounds.min, max: bounds.max))
      .run(surroundings.occluders)
    let textured = try texturing.run(
      mesh, dense: mesh, occluders: around.outside, reconstruction: reconstruction,
      images: scene.photos.images, gains: surroundings.gains, context.part(from: 0.3, to: 1))
    return (textured.transformed(by: geometry.transform), reconstruction.registered.count)
  }
}

extension TileIndex.Tile {
  fileprivate init?(_ mesh: Mesh, photos: Int, _ file: URL) {
    guard let bounds = mesh.bounds else { return nil }
    self.init(
      file: file.lastPathComponent, minimum: [bounds.min.x, bounds.min.y, bounds.min.z],
      maximum: [bounds.max.x, bounds.max.y, bounds.max.z], triangles: mesh.triangles.count,
      photos: photos)
  }
}

extension Fingerprint {
  fileprivate mutating func add(_ geometry: ModelGeometry) {
    let (box, map) = (geometry.crop, geometry.transform)
    add(box == nil ? 0 : 1)
    for vector in [box?.center, box?.halfExtents, map.x, map.y, map.z, map.translation] {
      add(SIMD3<Double>(vector ?? .zero))
    }
    guard let rotation = box?.rotation else { return }
    for value in [rotation.x, rotation.y, rotation.z, rotation.w] { add(value) }
  }
}
