import Kernels
import SceneModel

/// Bakes the non-color maps from the dense surface.
struct MapBaking: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum distance of the dense from the textured surface, as a share of the mesh's diagonal.
    var reach: Float = 0.01
    /// Ambient-occlusion rays per texel; sixteen texels share theirs.
    var occlusionRays = 6
    /// Length of these rays, as a share of the mesh's diagonal.
    var occlusionReach: Float = 0.3
    /// Maximum texels of the low-frequency maps, ambient occlusion and roughness, over all
    /// textures: their side is halved until they fit.
    var smoothTexels = 5_000_000
    /// One value for the whole surface: photos alone don't separate gloss from color.
    /// UsdPreviewSurface models of photogrammetry programs commonly use it for unpolished objects.
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

  /// Prepares baking of `maps` onto `mesh`, whose triangles are those of `scene`.
  func prepared(
    _ maps: Set<TextureMap>, mesh: Mesh, scene: RayScene, dense: Mesh, layout: AtlasLayout,
    charts: [Int32], _ context: StageContext
  ) throws -> Prepared {
    let diagonal = mesh.bounds.map { ($0.max - $0.min).length } ?? 1
    var side = layout.side
    while side > 512, layout.count * side * side > options.smoothTexels { side /= 2 }
    let needsDense = !maps.isDisjoint(with: [.normal, .displacement, .ambientOcclusion])
    return Prepared(
      maps: maps, options: options, scene: scene, layout: layout,
      smooth: layout.scaled(toSide: side),
      source: needsDense
        ? try source(mesh, dense, layout, charts, reach: options.reach * diagonal, context) : nil,
      diagonal: diagonal)
  }

  /// The dense surface with the tangent frames of the textured one.
  private func source(
    _ mesh: Mesh, _ dense: Mesh, _ layout: AtlasLayout, _ charts: [Int32], reach: Float,
    _ context: StageContext
  ) throws -> BakeSource {
    let normals = mesh.triangles.flatMap { $0.vertices.map { mesh.normals[$0] } }
    let denseNormals =
      dense.normals.count == dense.positions.count ? dense.normals : dense.angleWeightedNormals()
    return BakeSource(
      maximumDistance: reach, cornerNormals: normals,
      cornerTangents: TangentFrames().run(mesh, texels: layout.corners, charts: charts),
      dense: try RayScene(dense, context.control), denseNormals: denseNormals)
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

/// Tangents at the corners as viewers derive them from texture coordinates: those of the triangles,
/// weighted by the angle at the vertex, merged within a chart (Mikkelsen's tangent space).
struct TangentFrames: Sendable {
  /// `texels` holds texture coordinates with y down, three per triangle. The fourth component of
  /// the result is the sign of the bitangent, which points up in the texture.
  func run(_ mesh: Mesh, texels: [SIMD2<Float>], charts: [Int32]) -> [SIMD4<Float>] {
    // Few charts meet at a vertex: lists are shorter than dictionaries.
    var sums = [[(chart: Int32, sum: SIMD3<Float>)]](repeating: [], count: mesh.positions.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      let tangent = Self.tangent(mesh, face, texels)
      for (corner, vertex) in triangle.vertices.enumerated() {
        let normal = mesh.normals[vertex]
        let flat = (tangent - normal * normal.dot(tangent)).normalized
        let weighted = flat * Self.angle(mesh, triangle.vertices, corner)
        if let place = sums[vertex].firstIndex(where: { $0.chart == charts[face] }) {
          sums[vertex][place].sum += weighted
        } else {
          sums[vertex].append((charts[face], weighted))
        }
      }
    }
    var result: [SIMD4<Float>] = []
    result.reserveCapacity(texels.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      for vertex in triangle.vertices {
        let sum = sums[vertex].first { $0.chart == charts[face] }?.sum ?? .zero
        let unit = sum.normalized
        // Charts are never mirrored, so the frame is right-handed everywhere.
        result.append(SIMD4(unit, 1))
      }
    }
    return result
  }

  /// The direction in space of increasing u.
  private static func tangent(
    _ mesh: Mesh, _ face: Int, _ texels: [SIMD2<Float>]
  ) -> SIMD3<Float> {
    let (a, b, c) = mesh.corners(of: mesh.triangles[face])
    let (t, r, s) = (texels[3 * face], texels[3 * face + 1], texels[3 * face + 2])
    let (e1, e2) = (r - t, s - t)
    let determinant = e1.x * e2.y - e1.y * e2.x
    guard abs(determinant) > 1e-12 else { return (b - a).normalized }
    return (((b - a) * e2.y - (c - a) * e1.y) / determinant).normalized
  }

  private static func angle(_ mesh: Mesh, _ vertices: [Int], _ corner: Int) -> Float {
    let p = mesh.positions[vertices[corner]]
    return Mesh.angle(
      mesh.positions[vertices[(corner + 1) % 3]] - p,
      mesh.positions[vertices[(corner + 2) % 3]] - p)
  }
}
