import SceneModel

/// Intersects rays with triangles, using a bounding volume hierarchy.
package struct RayCaster: Sendable {
  /// The first intersection of a ray with a surface.
  package struct Hit: Sendable {
    /// Index of the triangle in the list passed to the initializer.
    package var triangle: Int
    /// In multiples of the direction's length.
    package var distance: Float
    /// Barycentric coordinates of the triangle's second and third corner.
    package var u: Float
    package var v: Float
  }

  private struct Node {
    var low: SIMD3<Float>
    var high: SIMD3<Float>
    /// Index of the next node if the ray misses the box.
    var skip: Int32
    /// Range in `triangles`; empty for inner nodes, whose first child follows.
    var first: Int32
    var count: Int32
  }

  private struct Corners {
    var origin: SIMD3<Float>
    var edge1: SIMD3<Float>
    var edge2: SIMD3<Float>
    var index: Int32
  }

  private var nodes: [Node] = []
  private var triangles: [Corners] = []

  package init(_ corners: [(SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)]) {
    triangles = corners.enumerated().map { index, c in
      Corners(origin: c.0, edge1: c.1 - c.0, edge2: c.2 - c.0, index: Int32(index))
    }
    if !triangles.isEmpty { build(0..<triangles.count) }
  }

  /// Splits at the median along the longest side of the bounding box of the centers.
  private mutating func build(_ range: Range<Int>) {
    func center(_ t: Corners) -> SIMD3<Float> { t.origin + (t.edge1 + t.edge2) / 3 }
    var low = SIMD3<Float>(repeating: .infinity)
    var high = -low
    var (centerLow, centerHigh) = (low, high)
    for t in triangles[range] {
      for p in [t.origin, t.origin + t.edge1, t.origin + t.edge2] {
        low = pointwiseMin(low, p)
        high = pointwiseMax(high, p)
      }
      centerLow = pointwiseMin(centerLow, center(t))
      centerHigh = pointwiseMax(centerHigh, center(t))
    }
    let index = nodes.count
    let isLeaf = range.count <= 4
    nodes.append(
      Node(
        low: low, high: high, skip: 0, first: Int32(range.lowerBound),
        count: isLeaf ? Int32(range.count) : 0))
    if !isLeaf {
      let size = centerHigh - centerLow
      let axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2
      triangles[range].sort {
        let (a, b) = (center($0)[axis], center($1)[axis])
        return a != b ? a < b : $0.index < $1.index
      }
      let middle = (range.lowerBound + range.upperBound) / 2
      build(range.lowerBound..<middle)
      build(middle..<range.upperBound)
    }
    nodes[index].skip = Int32(nodes.count)
  }

  /// The nearest hit of a ray between `nearest` and `farthest` multiples of its direction.
  package func hit(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, nearest: Float = 1e-5,
    farthest: Float = .infinity
  ) -> Hit? {
    traverse(origin, direction, nearest, farthest, stopsAtAny: false)
  }

  /// Whether there is any hit between `nearest` and `farthest` multiples of the direction.
  package func isBlocked(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, nearest: Float = 1e-5,
    farthest: Float = .infinity
  ) -> Bool {
    traverse(origin, direction, nearest, farthest, stopsAtAny: true) != nil
  }

  private func traverse(
    _ origin: SIMD3<Float>, _ direction: SIMD3<Float>, _ nearest: Float, _ farthest: Float,
    stopsAtAny: Bool
  ) -> Hit? {
    let inverse = 1 / direction
    var best: Hit?
    var limit = farthest
    var index = 0
    while index < nodes.count {
      let node = nodes[index]
      let a = (node.low - origin) * inverse
      let b = (node.high - origin) * inverse
      let enter = pointwiseMin(a, b).max()
      let leave = pointwiseMax(a, b).min()
      // The comparisons are such that NaN (a ray inside a face of the box) enters.
      if enter > leave || enter > limit || leave < nearest {
        index = Int(node.skip)
        continue
      }
      for position in Int(node.first)..<Int(node.first + node.count) {
        guard let hit = Self.intersect(triangles[position], origin, direction, nearest, limit)
        else { continue }
        best = hit
        if stopsAtAny { return best }
        limit = hit.distance
      }
      index += 1
    }
    return best
  }

  /// Ray–triangle intersection (Möller and Trumbore, 1997).
  private static func intersect(
    _ t: Corners, _ origin: SIMD3<Float>, _ direction: SIMD3<Float>, _ nearest: Float,
    _ farthest: Float
  ) -> Hit? {
    let p = direction.cross(t.edge2)
    let determinant = t.edge1.dot(p)
    guard abs(determinant) > 1e-14 else { return nil }
    let s = origin - t.origin
    let u = s.dot(p) / determinant
    guard u >= 0, u <= 1 else { return nil }
    let q = s.cross(t.edge1)
    let v = direction.dot(q) / determinant
    guard v >= 0, u + v <= 1 else { return nil }
    let distance = t.edge2.dot(q) / determinant
    guard distance > nearest, distance < farthest else { return nil }
    return Hit(triangle: Int(t.index), distance: distance, u: u, v: v)
  }
}
