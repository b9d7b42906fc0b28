import SceneModel

/// A vertex in a picture.
struct ScreenVertex: Hashable, Sendable {
  /// Parts of a sample that places are rounded to.
  static let subdivision = 256.0

  /// In parts of a sample, from the top-left corner of the picture.
  var x: Int32
  var y: Int32
  /// 1 / z in the camera's frame; linear in the picture.
  var inverseDepth: Float
}

/// Which triangle is nearest at each sample of a picture: a z-buffer that keeps the triangle
/// and no colour, so that each sample is shaded once.
struct VisibilityBuffer: Sendable {
  let width: Int
  let height: Int
  /// By sample, top row first; -1 where there is nothing.
  private(set) var triangles: [Int32]
  /// 0 where there is nothing.
  private var inverseDepths: [Float]

  init(width: Int, height: Int) {
    (self.width, self.height) = (width, height)
    triangles = [Int32](repeating: -1, count: width * height)
    inverseDepths = [Float](repeating: 0, count: width * height)
  }

  /// Draws a triangle, front or back, over what is behind it; of equal depths the first one stays.
  ///
  /// A sample belongs to the triangle that covers its centre, and on an edge that two share to one of
  /// them: edge functions are integers (Pineda, SIGGRAPH 1988), with the top-left rule.
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

  /// The first and the last of `count` columns, or rows, whose centres lie between three places.
  private func span(_ a: Int32, _ b: Int32, _ c: Int32, _ count: Int) -> (first: Int, last: Int) {
    let (low, high) = (Int(min(a, b, c)), Int(max(a, b, c)))
    return (max(0, (low + 127) >> 8), min(count - 1, (high - 128) >> 8))
  }
}

/// The edge functions of a triangle in a picture: at a place inside, each is positive, and its share
/// of their sum is the weight of the opposite corner.
struct TriangleEdges: Sendable {
  /// Twice the area on one side of an edge and a place.
  struct Edge: Sendable {
    /// At the centre of the sample in the corner.
    let origin: Int64
    /// From sample to sample.
    let stepX: Int64
    let stepY: Int64
    /// 0 for a top or left edge, whose places belong to the triangle, else 1.
    let exclusion: Int64

    init(from a: ScreenVertex, to b: ScreenVertex, sign: Int64) {
      let (x, y) = (Int64(b.x) - Int64(a.x), Int64(b.y) - Int64(a.y))
      let (dx, dy) = (sign * x, sign * y)
      origin = dx * (128 - Int64(a.y)) - dy * (128 - Int64(a.x))
      (stepX, stepY) = (-256 * dy, 256 * dx)
      exclusion = dy < 0 || (dy == 0 && dx > 0) ? 0 : 1
    }

    func value(_ x: Int, _ y: Int) -> Int64 { origin &+ Int64(x) &* stepX &+ Int64(y) &* stepY }
  }

  /// Opposite the corners of these names.
  let a: Edge
  let b: Edge
  let c: Edge
  /// One over the sum of the three functions, which is 2¹⁷ times the area in samples.
  let inverseArea: Float
  /// Whether the viewer sees the outside.
  let isFront: Bool

  /// Nil for a triangle without area.
  init?(_ a: ScreenVertex, _ b: ScreenVertex, _ c: ScreenVertex) {
    let (ux, uy) = (Int64(b.x) - Int64(a.x), Int64(b.y) - Int64(a.y))
    let (vx, vy) = (Int64(c.x) - Int64(a.x), Int64(c.y) - Int64(a.y))
    let area = ux * vy - uy * vx
    guard area != 0 else { return nil }
    // y points down: what is counter-clockwise to the eye has a negative area.
    isFront = area < 0
    let sign: Int64 = isFront ? -1 : 1
    self.a = Edge(from: b, to: c, sign: sign)
    self.b = Edge(from: c, to: a, sign: sign)
    self.c = Edge(from: a, to: b, sign: sign)
    inverseArea = 1 / Float(abs(area))
  }

  /// The three functions at the centre of a sample.
  func values(x: Int, y: Int) -> (a: Int64, b: Int64, c: Int64) {
    (a.value(x, y), b.value(x, y), c.value(x, y))
  }
}
