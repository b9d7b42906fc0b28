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

    var range: Range<Int> { Int(first)..<Int(first + count) }

    /// Where a ray enters the box, at least `nearest`; infinite if it misses the box or leaves it
    /// before.
    @inline(__always)
    func entry(
      _ origin: SIMD3<Float>, _ inverse: SIMD3<Float>, _ nearest: Float
    ) -> Float {
      let a = (low - origin) * inverse
      let b = (high - origin) * inverse
      // The sides in the order in which the ray crosses their planes. NaN (a ray inside a face of
      // the box) drops out of the comparisons, so that the ray enters.
      let first = a.replacing(with: b, where: inverse .< 0)
      let last = b.replacing(with: a, where: inverse .< 0)
      var (enter, leave) = (nearest, Float.infinity)
      if first.x > enter { enter = first.x }
      if first.y > enter { enter = first.y }
      if first.z > enter { enter = first.z }
      if last.x < leave { leave = last.x }
      if last.y < leave { leave = last.y }
      if last.z < leave { leave = last.z }
      return enter > leave ? .infinity : enter
    }
  }

  private struct Corners {
    var origin: SIMD3<Float>
    var edge1: SIMD3<Float>
    var edge2: SIMD3<Float>
    var index: Int32

    var center: SIMD3<Float> { origin + (edge1 + edge2) / 3 }

    var box: Box { Box().union(origin).union(origin + edge1).union(origin + edge2) }
  }

  /// An axis-aligned box, empty at first.
  private struct Box {
    var low = SIMD3<Float>(repeating: .infinity)
    var high = SIMD3<Float>(repeating: -.infinity)

    /// Half of the surface area.
    var area: Float {
      let size = high - low
      return size.x * size.y + size.y * size.z + size.z * size.x
    }

    func union(_ point: SIMD3<Float>) -> Box {
      Box(low: pointwiseMin(low, point), high: pointwiseMax(high, point))
    }

    func union(_ other: Box) -> Box {
      Box(low: pointwiseMin(low, other.low), high: pointwiseMax(high, other.high))
    }
  }

  private var nodes: [Node] = []
  private var triangles: [Corners] = []

  package init(_ corners: [(SIMD3<Float>, SIMD3<Float>, SIMD3<Float>)]) {
    triangles = corners.enumerated().map { index, c in
      Corners(origin: c.0, edge1: c.1 - c.0, edge2: c.2 - c.0, index: Int32(index))
    }
    if !triangles.isEmpty { build(0..<triangles.count) }
  }

  /// Adds the node of a range of triangles and those below it. From a depth on they are divided in
  /// halves, so that a ray never has to remember more than 64 nodes.
  private mutating func build(_ range: Range<Int>, depth: Int = 0) {
    let box = triangles[range].reduce(Box()) { $0.union($1.box) }
    let index = nodes.count
    let isLeaf = range.count <= 4
    nodes.append(
      Node(
        low: box.low, high: box.high, skip: 0, first: Int32(range.lowerBound),
        count: isLeaf ? Int32(range.count) : 0))
    if !isLeaf {
      let middle = split(range, isBalanced: depth > 30)
      build(range.lowerBound..<middle, depth: depth + 1)
      build(middle..<range.upperBound, depth: depth + 1)
    }
    nodes[index].skip = Int32(nodes.count)
  }

  /// Divides triangles in two parts where the surface area heuristic expects the least cost (Wald,
  /// "On fast construction of SAH-based bounding volume hierarchies", 2007), and returns the first
  /// of the second part.
  private mutating func split(_ range: Range<Int>, isBalanced: Bool) -> Int {
    let centers = triangles[range].reduce(Box()) { $0.union($1.center) }
    let size = centers.high - centers.low
    let scale = Float(Self.binCount) * 0.999_999 / pointwiseMax(size, SIMD3(repeating: 1e-30))
    func bin(_ triangle: Corners, _ axis: Int) -> Int {
      let place = (triangle.center[axis] - centers.low[axis]) * scale[axis]
      // The first for values that aren't numbers, too.
      return place > 0 ? Int(min(place, Float(Self.binCount - 1))) : 0
    }
    var best: (cost: Float, axis: Int, bin: Int)?
    for axis in 0..<3 where size[axis] > 0 && !isBalanced {
      var bins = [(box: Box, count: Int)](repeating: (Box(), 0), count: Self.binCount)
      for triangle in triangles[range] {
        let number = bin(triangle, axis)
        bins[number] = (bins[number].box.union(triangle.box), bins[number].count + 1)
      }
      let costs = Self.costs(bins)
      for (number, cost) in zip(1..., costs) where cost < best?.cost ?? .infinity {
        best = (cost, axis, number)
      }
    }
    let middle = (range.lowerBound + range.upperBound) / 2
    guard let best else { return middle }
    let parts = [true, false].map { isFirst in
      triangles[range].filter { (bin($0, best.axis) < best.bin) == isFirst }
    }
    triangles.replaceSubrange(range, with: parts[0] + parts[1])
    return range.lowerBound + parts[0].count
  }

  /// Chosen: more bins hardly change the tree.
  private static let binCount = 16

  /// The costs of dividing before each bin but the first; infinite if a part is empty.
  private static func costs(_ bins: [(box: Box, count: Int)]) -> [Float] {
    func partial(_ bins: some Sequence<(box: Box, count: Int)>) -> [Float] {
      var (box, count) = (Box(), 0)
      return bins.map { bin in
        (box, count) = (box.union(bin.box), count + bin.count)
        return count > 0 ? Float(count) * box.area : .infinity
      }
    }
    let (before, after) = (partial(bins), partial(bins.reversed()))
    return (1..<bins.count).map { before[$0 - 1] + after[bins.count - 1 - $0] }
  }

  /// The nearest hit of a ray between `nearest` and `farthest` multiples of its direction.
  package func hit(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, nearest: Float = 1e-5,
    farthest: Float = .infinity
  ) -> Hit? {
    guard !nodes.isEmpty else { return nil }
    let inverse = 1 / direction
    var best = Hit(triangle: -1, distance: farthest, u: 0, v: 0)
    // The nodes that remain, and where the ray enters them.
    var rest = InlineArray<64, (node: Int32, enter: Float)>(repeating: (0, nearest))
    var count = 1
    while count > 0 {
      count -= 1
      let (node, enter) = rest[count]
      let index = Int(node)
      // Rounding must not separate triangles at the same distance.
      if enter > best.distance * 1.000_001 { continue }
      if nodes[index].count > 0 {
        for position in nodes[index].range {
          // Of equally distant triangles the first counts, whichever is visited first.
          let isBefore = triangles[position].index < best.triangle
          let limit = isBefore ? best.distance.nextUp : best.distance
          if let hit = Self.intersect(triangles[position], origin, direction, nearest, limit) {
            best = hit
          }
        }
        continue
      }
      let (first, second) = (index + 1, Int(nodes[index + 1].skip))
      let a = nodes[first].entry(origin, inverse, nearest)
      let b = nodes[second].entry(origin, inverse, nearest)
      // The nearer child is visited first.
      if a > b {
        if a < .infinity { (rest[count], count) = ((Int32(first), a), count + 1) }
        if b < .infinity { (rest[count], count) = ((Int32(second), b), count + 1) }
      } else {
        if b < .infinity { (rest[count], count) = ((Int32(second), b), count + 1) }
        if a < .infinity { (rest[count], count) = ((Int32(first), a), count + 1) }
      }
    }
    return best.triangle < 0 ? nil : best
  }

  /// Whether there is any hit between `nearest` and `farthest` multiples of the direction.
  package func isBlocked(
    from origin: SIMD3<Float>, along direction: SIMD3<Float>, nearest: Float = 1e-5,
    farthest: Float = .infinity
  ) -> Bool {
    let inverse = 1 / direction
    var index = 0
    while index < nodes.count {
      let enter = nodes[index].entry(origin, inverse, nearest)
      if enter > farthest || enter == .infinity {
        index = Int(nodes[index].skip)
        continue
      }
      for position in nodes[index].range
      where Self.intersect(triangles[position], origin, direction, nearest, farthest) != nil {
        return true
      }
      index += 1
    }
    return false
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
