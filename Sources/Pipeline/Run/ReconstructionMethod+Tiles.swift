import Foundation
import Kernels
import SceneModel

extension ReconstructionMethod {
  /// Makes the surface of the scene in tiles of full detail, textures each and writes it. The tiles
  /// contain the part of the surface inside the crop box, moved by the transform.
  func writeTiles(
    of scene: ObjectScene, _ cloud: PointCloud, in geometry: ModelGeometry, to output: TileOutput,
    _ context: StageContext
  ) throws {
    try output.prepare()
    // What is noted of a tile concerns no other.
    let own = StageContext(control: context.control)
    let scratch = try ScratchFolder()
    let solutions = try solveTiles(scene, cloud, in: scratch.url, own.part(from: 0, to: 0.3))
    let tiles = try TexturedTiles(
      self, solutions, scene, cloud: cloud, whole: try surface(scene), geometry)
    var index = TileIndex(isMetric: scene.reconstruction.worldFrame.scale.isMetric)
    let count = solutions.base.grid.boxes.count
    for tile in 0..<count {
      let (start, end) = (Double(tile) / Double(count), Double(tile + 1) / Double(count))
      let part = own.part(from: 0.3 + 0.7 * start, to: 0.3 + 0.7 * end)
      guard let model = try tiles.model(tile, part) else { continue }
      let file = output.file(index.tiles.count + 1)
      try ModelExport(options: configuration.export)
        .run(model.mesh, to: file, part.part(from: 1, to: 1))
      index.add(model.mesh.mesh, photos: model.photos, file)
    }
    try output.write(index)
    context.notes.record("tiles", Double(index.tiles.count))
  }

  /// Divides the scene and solves all tiles.
  private func solveTiles(
    _ scene: ObjectScene, _ cloud: PointCloud, in folder: URL, _ context: StageContext
  ) throws -> TileSolutions {
    let (images, reconstruction) = (scene.photos.images, scene.reconstruction)
    let control = context.part(from: 0, to: 0).control
    let tiling = Tiling(
      options: configuration.tiling, meshing: MeshGeneration(configuration.meshGeneration),
      reconstruction: reconstruction,
      silhouettes: try Silhouettes(reconstruction, images: images, control))
    let views = try PointCloudGeneration(options: configuration.pointCloudGeneration)
      .fusedViews(
        reconstruction, images: images, folder: try cache.viewFolder(),
        context.part(from: 0, to: 0))
    let base = try tiling.base(cloud, support: scene.support, views, context.part(from: 0, to: 0.3))
    var points = TilePoints(base.grid, reach: tiling.reach(base), in: folder)
    for view in 0..<views.count {
      try control.step(0)
      try points.add(try views.points(view))
    }
    var solutions = TileSolutions(tiling, base, in: folder)
    let count = base.grid.boxes.count
    for tile in 0..<count {
      let (start, end) = (Double(tile) / Double(count), Double(tile + 1) / Double(count))
      try solutions.solve(
        tile, try points.points(of: tile),
        context.part(from: 0.3 + 0.7 * start, to: 0.3 + 0.7 * end))
    }
    return solutions
  }
}

/// Textures the tiles of a scene.
private struct TexturedTiles {
  private let solutions: TileSolutions
  private let scene: ObjectScene
  /// All points that the photos observe.
  private let observed: PointCloud
  /// The surface of the whole scene, which may hide a tile from a photo.
  private let occluders: Mesh
  private let geometry: ModelGeometry
  private let texturing: TextureMapping

  /// `whole` is the surface of the whole scene.
  init(
    _ method: ReconstructionMethod, _ solutions: TileSolutions, _ scene: ObjectScene,
    cloud: PointCloud, whole: Mesh, _ geometry: ModelGeometry
  ) throws {
    (self.solutions, self.scene, self.geometry) = (solutions, scene, geometry)
    var observed = cloud
    observed.append(scene.surroundings)
    self.observed = observed
    var options = method.configuration.textureMapping
    let tiling = method.configuration.tiling
    options.presence = nil
    options.textureSide = tiling.textureSide
    options.maximumAtlases = tiling.maximumAtlases
    options.maps = [.diffuseColor]
    texturing = TextureMapping(options: options)
    occluders = try whole.simplified(
      maximumTriangles: options.occluderTriangles, KernelControl())
  }

  /// The textured model of a tile, and the number of photos that show it; nil if it has no surface.
  func model(_ tile: Int, _ context: StageContext) throws -> (mesh: TexturedMesh, photos: Int)? {
    guard
      let (surface, photos) = try solutions.surface(
        tile, scene: observed, context.part(from: 0, to: 0.3))
    else { return nil }
    let mesh = geometry.crop.map { MeshCropping(box: $0).run(surface).inside } ?? surface
    guard !mesh.triangles.isEmpty, let bounds = mesh.bounds else { return nil }
    var reconstruction = scene.reconstruction
    for photo in reconstruction.poses.indices
    where UInt16(exactly: photo).map(photos.contains) != true {
      reconstruction.poses[photo] = nil
    }
    let around = MeshCropping(box: OrientedBox(min: bounds.min, max: bounds.max)).run(occluders)
    let textured = try texturing.run(
      mesh, dense: mesh, occluders: around.outside, reconstruction: reconstruction,
      images: scene.photos.images, context.part(from: 0.3, to: 1))
    return (textured.transformed(by: geometry.transform), reconstruction.registered.count)
  }
}

extension TileIndex {
  fileprivate mutating func add(_ mesh: Mesh, photos: Int, _ file: URL) {
    guard let bounds = mesh.bounds else { return }
    tiles.append(
      Tile(
        file: file.lastPathComponent, minimum: [bounds.min.x, bounds.min.y, bounds.min.z],
        maximum: [bounds.max.x, bounds.max.y, bounds.max.z], triangles: mesh.triangles.count,
        photos: photos))
  }
}
