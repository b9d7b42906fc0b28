import SceneModel

/// Parts that each have a texture of their own; a point has that of the nearest part.
struct PaintedParts: SurfaceTexture {
  struct Part: Sendable {
    var solid: Solid
    var texture: any SurfaceTexture

    init(_ solid: Solid, _ texture: any SurfaceTexture) {
      (self.solid, self.texture) = (solid, texture)
    }
  }

  let parts: [Part]

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    var (first, second) = (0, 0)
    var (least, next) = (Float.infinity, Float.infinity)
    for (index, part) in parts.enumerated() {
      let distance = part.solid.distance(point)
      if distance < least {
        (second, next) = (first, least)
        (first, least) = (index, distance)
      } else if distance < next {
        (second, next) = (index, distance)
      }
    }
    guard let part = parts.indices.contains(first) ? parts[first] : nil else { return .zero }
    let color = part.texture.color(at: point, footprint: footprint)
    // A pixel on a border shows both.
    let share = coverage((least - next) / 2, footprint)
    guard share < 1 else { return color }
    let other = parts[second].texture.color(at: point, footprint: footprint)
    return other + (color - other) * share
  }
}
