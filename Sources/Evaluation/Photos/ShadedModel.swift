import Formats
import ImageFiles
import Kernels
import SceneModel
import SceneRendering

/// A textured model that is drawn as cameras see it, without light or shadow: one ray through the
/// center of each pixel, textures interpolated bilinearly.
package struct ShadedModel: Sendable {
  private struct Part: Sendable {
    var texture: RasterImage?
    var factor: SIMD3<Float>
    var color: SIMD3<Float>
  }

  /// The color of pixels that show no surface. Chosen: the middle of the range.
  package static let background = SIMD3<Float>(repeating: 0.5)

  private let caster: RayCaster
  private let triangles: [Triangle]
  private let coordinates: [SIMD2<Float>]
  private let colors: [SIMD3<UInt8>]
  /// The part of each triangle.
  private let partOfTriangle: [Int32]
  private let parts: [Part]
  /// Whether any part has a texture or colors.
  package let hasColor: Bool

  /// The model moved by `transform`. Textures that can't be decoded are left out.
  package init(_ model: LoadedModel, _ transform: SimilarityTransform, _ control: KernelControl)
    throws
  {
    var positions: [SIMD3<Float>] = []
    var (triangles, coordinates): ([Triangle], [SIMD2<Float>]) = ([], [])
    var (colors, partOfTriangle): ([SIMD3<UInt8>], [Int32]) = ([], [])
    for (index, part) in model.parts.enumerated() {
      let base = UInt32(positions.count)
      let count = part.positions.count
      positions += part.positions.map { SIMD3<Float>(transform * SIMD3<Double>($0)) }
      coordinates +=
        part.textureCoordinates.isEmpty
        ? [SIMD2<Float>](repeating: .zero, count: count) : part.textureCoordinates
      colors +=
        part.colors.isEmpty
        ? [SIMD3<UInt8>](repeating: part.baseColorBytes, count: count) : part.colors
      triangles += part.triangles.map { Triangle(base + $0.a, base + $0.b, base + $0.c) }
      partOfTriangle += [Int32](repeating: Int32(index), count: part.triangles.count)
    }
    caster = RayCaster(
      triangles.map { (positions[Int($0.a)], positions[Int($0.b)], positions[Int($0.c)]) })
    let textures = try control.parallelMap(model.parts.count) { index in
      model.parts[index].textureCoordinates.isEmpty
        ? nil : model.parts[index].baseColor.flatMap { try? ImageCodec.decode($0.bytes) }
    }
    parts = zip(model.parts, textures).map { part, texture in
      Part(
        texture: texture, factor: part.baseColorFactor,
        color: SIMD3<Float>(part.baseColorBytes) / 255)
    }
    hasColor = zip(model.parts, textures).contains { $1 != nil || !$0.colors.isEmpty }
    (self.triangles, self.coordinates) = (triangles, coordinates)
    (self.colors, self.partOfTriangle) = (colors, partOfTriangle)
  }

  /// The color along a ray, 0…1 in sRGB; nil where there is no surface.
  func color(from origin: SIMD3<Float>, along direction: SIMD3<Float>) -> SIMD3<Float>? {
    guard let hit = caster.hit(from: origin, along: direction, nearest: 0) else { return nil }
    let (t, part) = (triangles[hit.triangle], parts[Int(partOfTriangle[hit.triangle])])
    let weights = SIMD3(1 - hit.u - hit.v, hit.u, hit.v)
    guard let texture = part.texture else {
      let corners = [t.a, t.b, t.c].map { SIMD3<Float>(colors[Int($0)]) / 255 }
      return corners[0] * weights.x + corners[1] * weights.y + corners[2] * weights.z
    }
    let (a, b, c) = (coordinates[Int(t.a)], coordinates[Int(t.b)], coordinates[Int(t.c)])
    let color = texture.bilinear(at: a * weights.x + b * weights.y + c * weights.z)
    guard part.factor != .one else { return color }
    let bytes = LinearColor(LinearColor(sRGB: color).components * part.factor).bytes
    return SIMD3<Float>(bytes) / 255
  }

  /// Whether a ray meets the surface.
  func isHit(from origin: SIMD3<Float>, along direction: SIMD3<Float>) -> Bool {
    caster.isBlocked(from: origin, along: direction, nearest: 0)
  }
}

extension RasterImage {
  /// The color at texture coordinates (origin at the bottom left), 0…1. Coordinates beyond 0…1
  /// take the color of the border.
  fileprivate func bilinear(at coordinate: SIMD2<Float>) -> SIMD3<Float> {
    let x = coordinate.x * Float(width) - 0.5
    let y = (1 - coordinate.y) * Float(height) - 0.5
    let (left, top) = (x.rounded(.down), y.rounded(.down))
    let (fx, fy) = (x - left, y - top)
    let columns = [left, left + 1].map { Int(min(max($0, 0), Float(width - 1))) }
    let rows = [top, top + 1].map { Int(min(max($0, 0), Float(height - 1))) }
    func texel(_ row: Int, _ column: Int) -> SIMD3<Float> {
      let at = (rows[row] * width + columns[column]) * channels
      return SIMD3(Float(pixels[at]), Float(pixels[at + 1]), Float(pixels[at + 2])) / 255
    }
    let upper = texel(0, 0) * (1 - fx) + texel(0, 1) * fx
    let lower = texel(1, 0) * (1 - fx) + texel(1, 1) * fx
    return upper * (1 - fy) + lower * fy
  }
}
