/// The edge functions of a triangle: all positive inside; each one's share of their sum is the
/// barycentric weight of the opposite corner.
struct TriangleEdges: Sendable {
  /// Twice the signed area spanned by an edge and a point.
  struct Edge: Sendable {
    /// Value at the center of the corner sample.
    let origin: Int64
    /// Increments from sample to sample.
    let stepX: Int64
    let stepY: Int64
    /// 0 for a top or left edge, whose points belong to the triangle, else 1.
    let exclusion: Int64

    init(from a: ScreenVertex, to b: ScreenVertex, sign: Int64) {
      let (x, y) = (Int64(b.x) - Int64(a.x), Int64(b.y) - Int64(a.y))
      let (dx, dy) = (sign * x, sign * y)
      let center = ScreenVertex.center
      origin = dx * (center - Int64(a.y)) - dy * (center - Int64(a.x))
      (stepX, stepY) = (-ScreenVertex.units * dy, ScreenVertex.units * dx)
      exclusion = dy < 0 || (dy == 0 && dx > 0) ? 0 : 1
    }

    func value(_ x: Int, _ y: Int) -> Int64 { origin &+ Int64(x) &* stepX &+ Int64(y) &* stepY }
  }

  /// Each edge is opposite the corner of the same name.
  let a: Edge
  let b: Edge
  let c: Edge
  /// One over the sum of the three functions, which is 2¹⁷ times the area in samples.
  let inverseArea: Float
  /// Whether the front face is visible.
  let isFront: Bool

  /// Nil for a degenerate triangle.
  init?(_ a: ScreenVertex, _ b: ScreenVertex, _ c: ScreenVertex) {
    let (ux, uy) = (Int64(b.x) - Int64(a.x), Int64(b.y) - Int64(a.y))
    let (vx, vy) = (Int64(c.x) - Int64(a.x), Int64(c.y) - Int64(a.y))
    let area = ux * vy - uy * vx
    guard area != 0 else { return nil }
    // y points down: counterclockwise in the picture means negative area.
    isFront = area < 0
    let sign: Int64 = isFront ? -1 : 1
    self.a = Edge(from: b, to: c, sign: sign)
    self.b = Edge(from: c, to: a, sign: sign)
    self.c = Edge(from: a, to: b, sign: sign)
    inverseArea = 1 / Float(abs(area))
  }

  /// The three functions at the center of a sample.
  func values(x: Int, y: Int) -> (a: Int64, b: Int64, c: Int64) {
    (a.value(x, y), b.value(x, y), c.value(x, y))
  }
}
