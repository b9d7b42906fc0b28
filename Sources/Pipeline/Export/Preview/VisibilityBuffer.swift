import SceneModel

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
