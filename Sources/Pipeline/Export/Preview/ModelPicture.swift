import Foundation
import SceneModel

/// Renders one picture of a textured model.
///
/// Colors are the texture's, slightly darkened where the surface turns away from the viewer to show
/// its shape; back faces have a distinct color.
struct ModelPicture: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Supersampling per direction: 3 takes nine samples per pixel. Chosen.
    var samplesPerSide = 3
    /// Share of light that a surface seen edge-on loses. Chosen.
    var shading: Float = 0.3
    /// The same for untextured surfaces. Chosen.
    var untexturedShading: Float = 0.75
    /// RGB of a surface without texture. Chosen.
    var untextured = SIMD3<UInt8>(205, 205, 205)
    var background = SIMD3<UInt8>(238, 238, 238)
    /// Color of back faces, so that a hole is visible as a hole. Chosen.
    var backFace = SIMD3<UInt8>(140, 108, 140)
  }

  let options: Options
  let model: TexturedMesh
  /// The diffuse texture by atlas.
  let textures: [MipMap?]

  /// The model as seen by a camera without distortion; it must lie in front of the camera and
  /// within the picture.
  func rendered(by camera: Camera, from pose: RigidTransform) -> RasterImage {
    let samples = camera.resized(
      width: camera.width * options.samplesPerSide, height: camera.height * options.samplesPerSide)
    let vertices = projected(samples, pose)
    var buffer = VisibilityBuffer(width: samples.width, height: samples.height)
    for (index, t) in model.mesh.triangles.enumerated() {
      buffer.draw(Int32(index), vertices[Int(t.a)], vertices[Int(t.b)], vertices[Int(t.c)])
    }
    // Sums of colors and, in the last component, sample counts.
    var sums = [SIMD4<Float>](repeating: .zero, count: camera.width * camera.height)
    let rays = ViewingRays(samples, pose)
    for (atlas, texture) in zip(model.atlases, textures) {
      shade(atlas.triangles, texture, buffer, vertices, rays, &sums)
    }
    return picture(camera.width, camera.height, sums)
  }

  /// The vertices in subsample coordinates.
  private func projected(_ camera: Camera, _ pose: RigidTransform) -> [ScreenVertex] {
    let matrix = pose.rotation.matrix
    let scale = camera.focalLength * ScreenVertex.subdivision
    let center = camera.principalPoint * ScreenVertex.subdivision
    return model.mesh.positions.map { position in
      let world = SIMD3<Double>(position)
      let inverse = 1 / (matrix.row2.dot(world) + pose.translation.z)
      let x = (matrix.row0.dot(world) + pose.translation.x) * inverse * scale.x + center.x
      let y = (matrix.row1.dot(world) + pose.translation.y) * inverse * scale.y + center.y
      return ScreenVertex(
        x: Int32(x.rounded()), y: Int32(y.rounded()), inverseDepth: Float(inverse))
    }
  }

  /// Averages the samples, with background where there are none.
  private func picture(_ width: Int, _ height: Int, _ sums: [SIMD4<Float>]) -> RasterImage {
    let all = Float(options.samplesPerSide * options.samplesPerSide)
    let background = SIMD3<Float>(options.background)
    var pixels: [UInt8] = []
    pixels.reserveCapacity(3 * sums.count)
    for sum in sums {
      let color = (SIMD3(sum.x, sum.y, sum.z) + background * (all - sum.w)) / all
      for channel in 0..<3 { pixels.append(UInt8(min(max(color[channel].rounded(), 0), 255))) }
    }
    return RasterImage(width: width, height: height, channels: 3, pixels: pixels)
  }
}

/// Viewing rays of a picture's samples.
private struct ViewingRays {
  let right: SIMD3<Float>
  let down: SIMD3<Float>
  let forward: SIMD3<Float>
  let center: SIMD2<Float>

  init(_ camera: Camera, _ pose: RigidTransform) {
    let matrix = pose.rotation.matrix
    right = SIMD3<Float>(matrix.row0)
    down = SIMD3<Float>(matrix.row1)
    // Pixels are square.
    forward = SIMD3<Float>(matrix.row2 * camera.focalLength.x)
    center = SIMD2<Float>(camera.principalPoint)
  }

  /// The unit vector toward the viewer at a sample.
  func direction(_ x: Int, _ y: Int) -> SIMD3<Float> {
    let offset = SIMD2(Float(x), Float(y)) + 0.5 - center
    return -(right * offset.x + down * offset.y + forward).normalized
  }
}

/// Per-triangle constants of shading.
private struct TriangleShading {
  let edges: TriangleEdges
  /// By corner.
  let inverseDepths: SIMD3<Float>
  let coordinates: (SIMD2<Float>, SIMD2<Float>, SIMD2<Float>)
  let normals: (SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)
  /// Texels per sample, times the cube of the inverse depth.
  let texelScale: Float

  init?(_ model: TexturedMesh, _ index: Int, _ vertices: [ScreenVertex], texels: Float) {
    let t = model.mesh.triangles[index]
    let (a, b, c) = (vertices[Int(t.a)], vertices[Int(t.b)], vertices[Int(t.c)])
    guard let edges = TriangleEdges(a, b, c) else { return nil }
    self.edges = edges
    inverseDepths = SIMD3(a.inverseDepth, b.inverseDepth, c.inverseDepth)
    let n = model.mesh.normals
    normals = (n[Int(t.a)], n[Int(t.b)], n[Int(t.c)])
    let s = model.textureTriangles[index]
    let uv = model.textureCoordinates
    coordinates = (uv[Int(s.a)], uv[Int(s.b)], uv[Int(s.c)])
    let (e, f) = (coordinates.1 - coordinates.0, coordinates.2 - coordinates.0)
    let texelArea = abs(e.x * f.y - e.y * f.x) * texels
    let part = Float(ScreenVertex.subdivision)
    let depths = inverseDepths.x * inverseDepths.y * inverseDepths.z
    texelScale = texelArea * edges.inverseArea * part * part * depths
  }

  /// The perspective-correct barycentric weights and the inverse depth at a sample.
  func weights(_ x: Int, _ y: Int) -> (corners: SIMD3<Float>, inverseDepth: Float) {
    let values = edges.values(x: x, y: y)
    let flat = SIMD3(Float(values.a), Float(values.b), Float(values.c)) * edges.inverseArea
    let divided = flat * inverseDepths
    let inverseDepth = divided.sum()
    return (divided / inverseDepth, inverseDepth)
  }
}

extension ModelPicture {
  /// Accumulates the shaded samples of an atlas's triangles into the pixels.
  private func shade(
    _ range: Range<Int>, _ texture: MipMap?, _ buffer: VisibilityBuffer,
    _ vertices: [ScreenVertex], _ rays: ViewingRays, _ sums: inout [SIMD4<Float>]
  ) {
    let (width, perSide) = (buffer.width, options.samplesPerSide)
    let backFace = SIMD3<Float>(options.backFace)
    var (current, shading) = (-1, TriangleShading?.none)
    for y in 0..<buffer.height {
      for x in 0..<width {
        let index = Int(buffer.triangles[y * width + x])
        guard index >= 0, range.contains(index) else { continue }
        if index != current {
          current = index
          shading = TriangleShading(model, index, vertices, texels: texture?.texelCount ?? 0)
        }
        guard let shading else { continue }
        let color =
          shading.edges.isFront ? color(x, y, shading, texture, rays) : backFace
        sums[y / perSide * (width / perSide) + x / perSide] += SIMD4(color, 1)
      }
    }
  }

  /// The shaded color of a front face at a sample, 0…255.
  private func color(
    _ x: Int, _ y: Int, _ triangle: TriangleShading, _ texture: MipMap?, _ rays: ViewingRays
  ) -> SIMD3<Float> {
    let (weights, inverseDepth) = triangle.weights(x, y)
    let (n, uv) = (triangle.normals, triangle.coordinates)
    let normal = (n.0 * weights.x + n.1 * weights.y + n.2 * weights.z).normalized
    let facing = min(max(normal.dot(rays.direction(x, y)), 0), 1)
    guard let texture else {
      let light = 1 - options.untexturedShading * (1 - facing)
      return SIMD3<Float>(options.untextured) * light
    }
    let coordinate = uv.0 * weights.x + uv.1 * weights.y + uv.2 * weights.z
    // The texture area that a sample covers, from the Jacobian of the projection.
    let texels = triangle.texelScale / (inverseDepth * inverseDepth * inverseDepth)
    let color = texture.color(coordinate, level: 0.5 * log2(texels))
    return color * (1 - options.shading * (1 - facing))
  }
}
