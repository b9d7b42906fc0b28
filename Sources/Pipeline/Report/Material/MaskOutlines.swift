import SceneModel

/// The outlines of a mask as closed polygons along the edges of its pixels.
struct MaskOutlines {
  /// Corners of each polygon in pixels; the object is on their left, seen with y down.
  let polygons: [[SIMD2<Int>]]

  /// An edge of a pixel, from one corner of the grid to the next.
  private struct Edge: Hashable {
    var from: SIMD2<Int>
    var direction: SIMD2<Int>
  }

  /// Values of 128 and more are the object.
  init(_ mask: RasterImage) {
    var open = Self.edges(of: mask)
    var order = open.sorted { ($0.from.y, $0.from.x) < ($1.from.y, $1.from.x) }
    order.reverse()
    var polygons: [[SIMD2<Int>]] = []
    while let first = order.popLast() {
      guard open.contains(first) else { continue }
      polygons.append(Self.loop(from: first, &open))
    }
    self.polygons = polygons
  }

  /// All edges between the object and what surrounds it.
  private static func edges(of mask: RasterImage) -> Set<Edge> {
    func isInside(_ x: Int, _ y: Int) -> Bool {
      x >= 0 && y >= 0 && x < mask.width && y < mask.height
        && mask.pixels[y * mask.width + x] >= 128
    }
    var edges = Set<Edge>()
    for y in 0..<mask.height {
      for x in 0..<mask.width where isInside(x, y) {
        if !isInside(x, y - 1) { edges.insert(Edge(from: [x, y], direction: [1, 0])) }
        if !isInside(x + 1, y) { edges.insert(Edge(from: [x + 1, y], direction: [0, 1])) }
        if !isInside(x, y + 1) { edges.insert(Edge(from: [x + 1, y + 1], direction: [-1, 0])) }
        if !isInside(x - 1, y) { edges.insert(Edge(from: [x, y + 1], direction: [0, -1])) }
      }
    }
    return edges
  }

  /// The polygons without the steps of pixels: corners are cut at a distance of one pixel, or at
  /// the middle of shorter sides.
  var smoothed: [[SIMD2<Double>]] {
    polygons.map { polygon in
      polygon.indices.flatMap { index -> [SIMD2<Double>] in
        let next = polygon[(index + 1) % polygon.count]
        let (a, b) = (SIMD2<Double>(polygon[index]), SIMD2<Double>(next))
        let side = b - a
        guard side.length > 2 else { return [(a + b) / 2] }
        return [a + side / side.length, b - side / side.length]
      }
    }
  }

  /// Follows edges back to the first one; its corners are where the direction changes.
  private static func loop(from first: Edge, _ open: inout Set<Edge>) -> [SIMD2<Int>] {
    var corners: [SIMD2<Int>] = []
    var edge = first
    while open.remove(edge) != nil {
      let end = edge.from &+ edge.direction
      let (d, right) = (edge.direction, SIMD2(-edge.direction.y, edge.direction.x))
      // Where two pixels touch at a corner, the turn towards the object keeps them apart.
      let next = [right, d, SIMD2(0, 0) &- right].map { Edge(from: end, direction: $0) }
        .first { open.contains($0) || $0 == first }
      if next?.direction != d { corners.append(end) }
      guard let next else { break }
      edge = next
    }
    return corners
  }
}
