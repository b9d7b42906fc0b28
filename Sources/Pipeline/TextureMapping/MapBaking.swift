import Kernels
import SceneModel

/// Bakes the non-color maps from the dense surface.
struct MapBaking: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum distance of the dense from the textured surface, as a share of the mesh's diagonal.
    /// Chosen.
    var reach: Float = 0.01
    /// Ambient-occlusion rays per texel; sixteen texels share theirs. Chosen: together, they have
    /// 96 rays.
    var occlusionRays = 6
    /// Length of these rays, as a share of the mesh's diagonal. Chosen.
    var occlusionReach: Float = 0.3
    /// Maximum texels of the low-frequency maps, ambient occlusion and roughness, over all
    /// textures: their side is halved until they fit. Chosen.
    var smoothTexels = 5_000_000
    /// One value for the whole surface: photos alone don't separate gloss from color.
    /// UsdPreviewSurface models of photogrammetry programs commonly use it for unpolished objects.
    /// Chosen.
    var roughness: Float = 0.9
  }

  var options = Options()

  /// The inputs shared by all textures of a model.
  struct Prepared {
    fileprivate var maps: Set<TextureMap>
    fileprivate var options: Options
    fileprivate var scene: RayScene
    fileprivate var layout: AtlasLayout
    /// The layout of the low-frequency maps.
    fileprivate var smooth: AtlasLayout
    fileprivate var source: BakeSource?
    fileprivate var diagonal: Float
  }

  /// The surface before simplification, for rays.
  struct DenseSurface {
    fileprivate var scene: RayScene
    fileprivate var normals: [SIMD3<Float>]
  }

  /// Nil if no map of `maps` shows the surface before simplification.
  func denseSurface(
    _ dense: Mesh, for maps: Set<TextureMap>, _ control: KernelControl
  ) throws -> DenseSurface? {
    guard !maps.isDisjoint(with: [.normal, .displacement, .ambientOcclusion]) else { return nil }
    return DenseSurface(
      scene: try RayScene(dense, control),
      normals: dense.normals.count == dense.positions.count
        ? dense.normals : dense.angleWeightedNormals())
  }

  /// Prepares baking of `maps` onto `mesh`, whose triangles are those of `scene`.
  func prepared(
    _ maps: Set<TextureMap>, mesh: Mesh, scene: RayScene, dense: DenseSurface?,
    layout: AtlasLayout, charts: [Int32]
  ) -> Prepared {
    let diagonal = mesh.bounds.map { ($0.max - $0.min).length } ?? 1
    var side = layout.side
    while side > 512, layout.count * side * side > options.smoothTexels { side /= 2 }
    return Prepared(
      maps: maps, options: options, scene: scene, layout: layout,
      smooth: layout.scaled(toSide: side),
      source: dense.map { source(mesh, $0, layout, charts, reach: options.reach * diagonal) },
      diagonal: diagonal)
  }

  /// The dense surface with the tangent frames of the textured one.
  private func source(
    _ mesh: Mesh, _ dense: DenseSurface, _ layout: AtlasLayout, _ charts: [Int32], reach: Float
  ) -> BakeSource {
    let normals = mesh.triangles.flatMap { $0.vertices.map { mesh.normals[$0] } }
    return BakeSource(
      maximumDistance: reach, cornerNormals: normals,
      cornerTangents: TangentFrames().run(mesh, texels: layout.corners, charts: charts),
      dense: dense.scene, denseNormals: dense.normals)
  }
}

extension MapBaking.Prepared {
  /// Bakes the maps for the triangles of one texture; `canvas` is that texture's.
  func run(
    on canvas: TextureCanvas, atlas: Int, _ context: StageContext
  ) throws -> [TextureMap: RasterImage] {
    var images: [TextureMap: RasterImage] = [:]
    if let source, maps.contains(.normal) || maps.contains(.displacement) {
      let baked = try canvas.bake(
        source, displacement: maps.contains(.displacement),
        context.part(from: 0, to: 0.5).control)
      if maps.contains(.normal) { images[.normal] = baked.normals }
      images[.displacement] = baked.displacement
    }
    if let source, maps.contains(.ambientOcclusion) {
      let part = context.part(from: 0.5, to: 1)
      images[.ambientOcclusion] = try smoothCanvas(canvas, atlas, part).occlusion(
        source, raysPerTexel: options.occlusionRays,
        maximumDistance: options.occlusionReach * diagonal, part.control)
    }
    if maps.contains(.roughness) {
      images[.roughness] = RasterImage(
        width: smooth.side, height: smooth.side, channels: 1,
        filledWith: UInt8((options.roughness * 255).rounded()))
    }
    return images
  }

  /// A canvas at the resolution of the low-frequency maps.
  private func smoothCanvas(
    _ canvas: TextureCanvas, _ atlas: Int, _ context: StageContext
  ) throws -> TextureCanvas {
    guard smooth.side < layout.side else { return canvas }
    return try TextureCanvas(
      scene, corners: smooth.corners(in: atlas), side: smooth.side, gutter: 1, context.control)
  }
}
