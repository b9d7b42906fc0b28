import Foundation
import Kernels
import SceneModel

extension ReconstructionMethod {
  /// Makes the surface of the scene in tiles of full detail, textures each and writes it. The tiles
  /// contain the part of the surface inside the crop box, moved by the transform.
  func writeTiles(in geometry: ModelGeometry, to output: TileOutput) throws {
    try output.prepare()
    let photos = try ingest()
    let scene = try maskObject(photos, try align(photos))
    let whole = try surface(scene)
    let cloud = try densify(scene)
    let scratch = try ScratchFolder()
    let solutions = try solveTiles(scene, cloud, in: scratch.url)
    var surroundings = cloud
    surroundings.append(scene.surroundings)
    try recorder.run(.textureMapping, images: photos.images) { context in
      var index = TileIndex(isMetric: scene.reconstruction.worldFrame.scale.isMetric)
      let occluders = try Simplification(
        options: .init(maximumTriangles: configuration.tiling.occluderTriangles)
      ).run(whole, context.part(from: 0, to: 0))
      let count = solutions.base.grid.boxes.count
      for tile in 0..<count {
        let part = context.part(
          from: Double(tile) / Double(count), to: Double(tile + 1) / Double(count))
        guard
          let model = try tileModel(
            tile, solutions, surroundings, scene, occluders, geometry, part)
        else { continue }
        let file = output.file(index.tiles.count + 1)
        try ModelExport(options: configuration.export)
          .run(model.mesh.transformed(by: geometry.transform), to: file, part.part(from: 1, to: 1))
        index.add(model.mesh, photos: model.photos, file)
      }
      try output.write(index)
      context.notes.record("tiles", Double(index.tiles.count))
    }
  }

  /// Divides the scene and solves all tiles.
  private func solveTiles(
    _ scene: ObjectScene, _ cloud: PointCloud, in folder: URL
  ) throws -> TileSolutions {
    let (photos, reconstruction) = (scene.photos, scene.reconstruction)
    return try recorder.run(.meshGeneration, images: photos.images) { context in
      let silhouettes = try Silhouettes(
        reconstruction, images: photos.images, context.control.part(from: 0, to: 0))
      let tiling = Tiling(
        options: configuration.tiling, meshing: MeshGeneration(configuration.meshGeneration),
        reconstruction: reconstruction, silhouettes: silhouettes)
      let views = try PointCloudGeneration(options: configuration.pointCloudGeneration)
        .fusedViews(
          reconstruction, images: photos.images, folder: try cache.viewFolder(),
          context.part(from: 0, to: 0))
      let base = try tiling.base(
        cloud, support: scene.support, views, context.part(from: 0, to: 0.3))
      var points = TilePoints(base.grid, reach: tiling.reach(base), in: folder)
      for view in 0..<views.count { try points.add(try views.points(view)) }
      try points.finish()
      let solutions = TileSolutions(tiling: tiling, base: base, folder: folder)
      let count = base.grid.boxes.count
      for tile in 0..<count {
        try solutions.solve(
          tile, try points.points(of: tile),
          context.part(
            from: 0.3 + 0.7 * Double(tile) / Double(count),
            to: 0.3 + 0.7 * Double(tile + 1) / Double(count)))
      }
      return solutions
    }
  }

  /// The textured model of a tile, and the number of photos that show it; nil if it has no surface.
  private func tileModel(
    _ tile: Int, _ solutions: TileSolutions, _ surroundings: PointCloud, _ scene: ObjectScene,
    _ occluders: Mesh, _ geometry: ModelGeometry, _ context: StageContext
  ) throws -> (mesh: TexturedMesh, photos: Int)? {
    guard
      let (surface, views) = try solutions.surface(
        tile, scene: surroundings, context.part(from: 0, to: 0.3))
    else { return nil }
    let mesh = geometry.crop.map { MeshCropping(box: $0).run(surface).inside } ?? surface
    guard !mesh.triangles.isEmpty, let bounds = mesh.bounds else { return nil }
    var reconstruction = scene.reconstruction
    for photo in reconstruction.poses.indices where views[UInt16(photo)] == nil {
      reconstruction.poses[photo] = nil
    }
    var texturing = TextureMapping(options: configuration.textureMapping)
    texturing.options.presence = nil
    texturing.options.textureSide = configuration.tiling.textureSide
    texturing.options.maximumAtlases = configuration.tiling.maximumAtlases
    texturing.options.maps = [.diffuseColor]
    let outside = MeshCropping(box: OrientedBox(min: bounds.min, max: bounds.max))
      .run(occluders).outside
    let textured = try texturing.run(
      mesh, dense: mesh, occluders: outside, reconstruction: reconstruction,
      images: scene.photos.images, context.part(from: 0.3, to: 1))
    return (textured, reconstruction.registered.count)
  }
}

extension TileIndex {
  fileprivate mutating func add(_ model: TexturedMesh, photos: Int, _ file: URL) {
    guard let bounds = model.mesh.bounds else { return }
    tiles.append(
      Tile(
        file: file.lastPathComponent, minimum: [bounds.min.x, bounds.min.y, bounds.min.z],
        maximum: [bounds.max.x, bounds.max.y, bounds.max.z],
        triangles: model.mesh.triangles.count, photos: photos))
  }
}
