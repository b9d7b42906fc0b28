import SceneModel

/// A projected vertex in fixed-point coordinates.
struct ScreenVertex: Hashable, Sendable {
  /// Fixed-point units per sample.
  static let subdivision = 256.0
  /// The same as an integer, and its number of bits.
  static let units: Int64 = 256
  static let unitBits = 8
  /// The center of a sample in these units.
  static let center: Int64 = 128

  /// In fixed-point units from the top-left corner of the picture.
  var x: Int32
  var y: Int32
  /// 1 / z in the camera frame; linear in the picture.
  var inverseDepth: Float
}

/// A visibility buffer: the nearest triangle at each sample of a picture, without color, so that
/// each sample is shaded once.
struct VisibilityBuffer: Sendable {
  let width: Int
  let height: Int
  /// By sample, top row first; −1 for none.
  private(set) var triangles: [Int32]
  /// 0 for none.
  private var inverseDepths: [Float]

  init(width: Int, height: Int) {
    (self.width, self.height) = (width, height)
    triangles = [Int32](repeating: -1, count: width * height)
    inverseDepths = [Float](repeating: 0, count: width * height)
  }

  /// Rasterizes a triangle, front or back, with a depth test; at equal depths the first one stays.
  ///
  /// A sample belongs to the triangle that covers its center, and on a shared edge to exactly one
  /// of the two: edge functions are integers (Pineda, SIGGRAPH 1988) with the top-left rule.
  mutating func draw(_ triangle: Int32, _ a: ScreenVertex, _ b: ScreenVertex, _ c: ScreenVertex) {
    guard let edges = TriangleEdges(a, b, c) else { return }
    let (left, right) = span(a.x, b.x, c.x, width)
    let (top, bottom) = span(a.y, b.y, c.y, height)
    guard left <= right, top <= bottom else { return }
    let slopeB = (b.inverseDepth - a.inverseDepth) * edges.inverseArea
    let slopeC = (c.inverseDepth - a.inverseDepth) * edges.inverseArea
    for y in top...bottom {
      var (ofA, ofB, ofC) = edges.values(x: left, y: y)
      ofA &-= edges.a.exclusion
      ofB &-= edges.b.exclusion
      ofC &-= edges.c.exclusion
      for x in left...right {
        if ofA | ofB | ofC >= 0 {
          let inverseDepth = a.inverseDepth + Float(ofB) * slopeB + Float(ofC) * slopeC
          let index = y * width + x
          if inverseDepth > inverseDepths[index] {
            inverseDepths[index] = inverseDepth
            triangles[index] = triangle
          }
        }
        ofA &+= edges.a.stepX
        ofB &+= edges.b.stepX
        ofC &+= edges.c.stepX
      }
    }
  }

  /// The first and the last of `count` columns, or rows, whose centers lie between three
  /// coordinates.
  private func span(_ a: Int32, _ b: Int32, _ c: Int32, _ count: Int) -> (first: Int, last: Int) {
    let (low, high) = (Int(min(a, b, c)), Int(max(a, b, c)))
    return (
      max(0, (low + Int(ScreenVertex.center) - 1) >> ScreenVertex.unitBits),
      min(count - 1, (high - Int(ScreenVertex.center)) >> ScreenVertex.unitBits)
    )
  }
}

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
