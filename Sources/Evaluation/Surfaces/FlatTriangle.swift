import SceneModel

/// A triangle given by its corners.
struct FlatTriangle: BoundedItem {
  var a: SIMD3<Float>
  var b: SIMD3<Float>
  var c: SIMD3<Float>

  init(_ triangle: Triangle, of mesh: Mesh) {
    a = mesh.positions[Int(triangle.a)]
    b = mesh.positions[Int(triangle.b)]
    c = mesh.positions[Int(triangle.c)]
  }

  init(_ a: SIMD3<Float>, _ b: SIMD3<Float>, _ c: SIMD3<Float>) {
    (self.a, self.b, self.c) = (a, b, c)
  }

  var bounds: (min: SIMD3<Float>, max: SIMD3<Float>) {
    (pointwiseMin(pointwiseMin(a, b), c), pointwiseMax(pointwiseMax(a, b), c))
  }

  /// Unit length, or zero for a degenerate triangle.
  var normal: SIMD3<Double> {
    let normal = SIMD3<Double>(b - a).cross(SIMD3<Double>(c - a))
    let length = normal.length
    return length > 0 ? normal / length : .zero
  }

  var area: Float { (b - a).cross(c - a).length / 2 }

  func squaredDistance(to point: SIMD3<Float>) -> Float {
    (closestPoint(to: point) - point).squaredLength
  }

  /// The closest point by Voronoi regions (Ericson, Real-Time Collision Detection, 5.1.5).
  func closestPoint(to p: SIMD3<Float>) -> SIMD3<Float> {
    let (ab, ac, ap) = (b - a, c - a, p - a)
    let (d1, d2) = (ab.dot(ap), ac.dot(ap))
    if d1 <= 0, d2 <= 0 { return a }
    let bp = p - b
    let (d3, d4) = (ab.dot(bp), ac.dot(bp))
    if d3 >= 0, d4 <= d3 { return b }
    let vc = d1 * d4 - d3 * d2
    if vc <= 0, d1 >= 0, d3 <= 0 { return a + ab * Self.ratio(d1, d1 - d3) }
    let cp = p - c
    let (d5, d6) = (ab.dot(cp), ac.dot(cp))
    if d6 >= 0, d5 <= d6 { return c }
    let vb = d5 * d2 - d1 * d6
    if vb <= 0, d2 >= 0, d6 <= 0 { return a + ac * Self.ratio(d2, d2 - d6) }
    let va = d3 * d6 - d5 * d4
    if va <= 0, d4 >= d3, d5 >= d6 {
      return b + (c - b) * Self.ratio(d4 - d3, (d4 - d3) + (d5 - d6))
    }
    let sum = va + vb + vc
    return a + ab * Self.ratio(vb, sum) + ac * Self.ratio(vc, sum)
  }

  /// a / b, or zero for degenerate triangles.
  private static func ratio(_ a: Float, _ b: Float) -> Float { b != 0 ? a / b : 0 }

  /// Whether the ray hits the triangle before `limit` (Möller and Trumbore, 1997).
  func isHit(from origin: SIMD3<Float>, direction: SIMD3<Float>, limit: Float) -> Bool {
    let (ab, ac) = (b - a, c - a)
    let p = direction.cross(ac)
    let determinant = ab.dot(p)
    guard determinant != 0 else { return false }
    let s = (origin - a) / determinant
    let u = s.dot(p)
    guard u >= 0, u <= 1 else { return false }
    let q = s.cross(ab)
    let v = direction.dot(q)
    guard v >= 0, u + v <= 1 else { return false }
    let t = ac.dot(q)
    return t > 0 && t < limit
  }
}
