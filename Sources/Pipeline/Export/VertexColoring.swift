import SceneModel

/// Converts a model's texture to vertex colors, for formats without images.
struct VertexColoring: Sendable {
  /// The mesh with vertex colors: its own if it has them, else sampled from the color map and
  /// averaged where charts meet; none without a color map.
  func run(_ model: TexturedMesh, _ context: StageContext) throws -> Mesh {
    try context.control.step(0)
    var mesh = model.mesh
    let isTextured =
      model.textureTriangles.count == mesh.triangles.count
      && model.atlases.contains { $0.maps[.diffuseColor] != nil }
    if mesh.colors.count != mesh.positions.count {
      mesh.colors = isTextured ? colors(of: model) : []
    }
    try context.control.step(1)
    return mesh
  }

  /// Sampled colors; vertices that no texture covers are gray.
  private func colors(of model: TexturedMesh) -> [SIMD3<UInt8>] {
    var sums = [SIMD4<Float>](repeating: .zero, count: model.mesh.positions.count)
    // A texture coordinate counts once per vertex, however many triangles share it.
    var owners = [Int](repeating: -1, count: model.textureCoordinates.count)
    for atlas in model.atlases {
      guard let image = atlas.maps[.diffuseColor] else { continue }
      func add(_ vertex: UInt32, _ coordinate: UInt32) {
        let (vertex, coordinate) = (Int(vertex), Int(coordinate))
        guard owners[coordinate] != vertex else { return }
        owners[coordinate] = vertex
        sums[vertex] += SIMD4(image.color(at: model.textureCoordinates[coordinate]), 1)
      }
      for face in atlas.triangles {
        let (corners, texels) = (model.mesh.triangles[face], model.textureTriangles[face])
        add(corners.a, texels.a)
        add(corners.b, texels.b)
        add(corners.c, texels.c)
      }
    }
    return sums.map { sum in
      guard sum.w > 0 else { return [128, 128, 128] }
      let mean = SIMD3(sum.x, sum.y, sum.z) / sum.w
      return SIMD3<UInt8>(mean.rounded(.toNearestOrAwayFromZero))
    }
  }
}

extension RasterImage {
  /// The bilinearly interpolated RGB or gray value, 0…255, at a texture coordinate whose (0, 0) is
  /// the bottom left.
  fileprivate func color(at coordinate: SIMD2<Float>) -> SIMD3<Float> {
    let size = SIMD2(Float(width), Float(height))
    let texel = SIMD2(coordinate.x, 1 - coordinate.y) * size - 0.5
    let inside = texel.clamped(lowerBound: .zero, upperBound: size - 1)
    let corner = inside.rounded(.down)
    let f = inside - corner
    let (x, y) = (Int(corner.x), Int(corner.y))
    let (right, below) = (min(x + 1, width - 1), min(y + 1, height - 1))
    let top = color(x, y) * (1 - f.x) + color(right, y) * f.x
    let bottom = color(x, below) * (1 - f.x) + color(right, below) * f.x
    return top * (1 - f.y) + bottom * f.y
  }

  private func color(_ x: Int, _ y: Int) -> SIMD3<Float> {
    let start = (y * width + x) * channels
    let (g, b) = channels >= 3 ? (1, 2) : (0, 0)
    return [Float(pixels[start]), Float(pixels[start + g]), Float(pixels[start + b])]
  }
}
