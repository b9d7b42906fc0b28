import Foundation
import Kernels
import SceneModel

/// Colours a surface with the photos it was made from (Waechter, Moehrle and Goesele, "Let There Be
/// Color!", ECCV 2014) and bakes what the simplified surface lost into maps.
package struct TextureMapping: Sendable {
  package struct Options: Sendable {
    /// Upper bound of the texture's side in texels; it is halved while the photos don't fill it.
    package var textureSide = 4096
    package var maps: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]

    var observation = ViewObservation.Options()
    var exposure = ExposureCompensation.Options()
    var candidates = ViewCandidates.Options()
    var selection = ViewSelection.Options()
    var blending = ViewBlending.Options()
    var leveling = ColorLeveling.Options()
    var charting = Charting.Options()
    var painting = TexturePainting.Options()
    var baking = MapBaking.Options()

    package init(
      textureSide: Int = 4096,
      maps: Set<TextureMap> = [.diffuseColor, .normal, .ambientOcclusion]
    ) {
      self.textureSide = textureSide
      self.maps = maps
    }
  }

  package var options: Options

  package init(options: Options = Options()) { self.options = options }

  /// Textures `mesh`, whose maps are baked from `dense`, the surface before simplification.
  package func run(
    _ mesh: Mesh, dense: Mesh, reconstruction: Reconstruction, images: ImageStore,
    _ context: StageContext
  ) throws -> TexturedMesh {
    let source = ViewSource(reconstruction: reconstruction) { photo, maximumPixels in
      try images.pinholeView(photo, of: reconstruction, maximumPixels: maximumPixels)
    }
    return try run(mesh, dense: dense, source: source, context)
  }

  func run(
    _ input: Mesh, dense: Mesh, source: ViewSource, _ context: StageContext
  ) throws -> TexturedMesh {
    let mesh = try checked(input)
    let views = source.reconstruction.registered
    let topology = MeshTopology(mesh)
    let scene = try RayScene(mesh, context.part(from: 0, to: 0).control)

    let seen = try ViewObservation(options: options.observation)
      .run(scene, views: views, source: source, context.part(from: 0, to: 0.3))
    let gains = try ExposureCompensation(options: options.exposure)
      .run(seen, viewCount: views.count, context.part(from: 0.3, to: 0.33))
    let rated = try ViewCandidates(options: options.candidates)
      .run(seen, gains: gains, context.part(from: 0.33, to: 0.35))
    let labels = try ViewSelection(options: options.selection)
      .run(rated, mesh: mesh, topology: topology, context.part(from: 0.35, to: 0.4))
    let weights = try ViewBlending(options: options.blending)
      .run(rated, labels: labels, mesh: mesh, topology: topology, context.part(from: 0.4, to: 0.41))
    let leveling = try ColorLeveling(options: options.leveling)
      .run(
        rated, weights: weights, mesh: mesh, topology: topology, context.part(from: 0.41, to: 0.46))

    let map = try Charting(options: options.charting)
      .run(mesh, rated: rated, labels: labels, context.part(from: 0.46, to: 0.5))
    let layout = try AtlasPacking(options: .init(maximumSide: options.textureSide))
      .run(map, context.part(from: 0.5, to: 0.6))
    let canvas = try TextureCanvas(
      scene, corners: layout.corners, side: layout.side, context.part(from: 0.6, to: 0.62).control)
    context.notes.count("textureSide", Double(layout.side))
    context.notes.count("textureUsage", canvas.usage)
    context.notes.count("texelsPerPixel", Double(layout.magnification))

    var maps = try MapBaking(options: options.baking)
      .run(
        options.maps, mesh: mesh, scene: scene, dense: dense, layout: layout, charts: map.charts,
        canvas: canvas, context.part(from: 0.62, to: 0.8))
    if options.maps.contains(.diffuseColor) {
      try TexturePainting(options: options.painting)
        .run(
          on: canvas, weights: weights, leveling: leveling, gains: gains, views: views,
          source: source, magnification: layout.magnification, context.part(from: 0.8, to: 0.98))
      maps[.diffuseColor] = try canvas.colors(context.part(from: 0.98, to: 1).control)
    }
    return assembled(mesh, layout, maps)
  }

  private func checked(_ input: Mesh) throws -> Mesh {
    guard !input.triangles.isEmpty else {
      throw PipelineError.noSurface(reason: "there is nothing to texture")
    }
    var mesh = input
    if mesh.normals.count != mesh.positions.count { mesh.normals = mesh.angleWeightedNormals() }
    return mesh
  }

  /// Corners with equal coordinates at one vertex share them.
  private func assembled(
    _ mesh: Mesh, _ layout: AtlasLayout, _ maps: [TextureMap: RasterImage]
  ) -> TexturedMesh {
    let side = Float(layout.side)
    var coordinates: [SIMD2<Float>] = []
    var known = [[UInt32]](repeating: [], count: mesh.positions.count)
    var triangles: [Triangle] = []
    triangles.reserveCapacity(mesh.triangles.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      let indices = triangle.vertices.enumerated().map { corner, vertex in
        let texel = layout.corners[3 * face + corner]
        let uv = SIMD2(texel.x / side, 1 - texel.y / side)
          .clamped(lowerBound: .zero, upperBound: .one)
        if let index = known[vertex].first(where: { coordinates[Int($0)] == uv }) { return index }
        coordinates.append(uv)
        known[vertex].append(UInt32(coordinates.count - 1))
        return UInt32(coordinates.count - 1)
      }
      triangles.append(Triangle(indices[0], indices[1], indices[2]))
    }
    return TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates, textureTriangles: triangles,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: maps)])
  }
}
