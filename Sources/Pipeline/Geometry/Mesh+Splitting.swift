import SceneModel

extension Mesh {
  /// The mesh with its triangles split along the line where `values`, one per position and linear
  /// in between, are zero. Normals and colors are dropped.
  ///
  /// A vertex within `snapping` of an edge from the line is moved onto it, which avoids slivers.
  func split(where values: [Float], snapping: Float = 0.15) -> Mesh {
    var splitting = MeshSplitting(positions: positions, values: values)
    splitting.snap(triangles, share: snapping)
    for triangle in triangles { splitting.add(triangle) }
    return Mesh(positions: splitting.positions, triangles: splitting.triangles)
  }
}

private struct MeshSplitting {
  var positions: [SIMD3<Float>]
  var values: [Float]
  private(set) var triangles: [Triangle] = []
  /// The vertex on each split edge, whose lower and higher vertex are the key.
  private var crossings: [SIMD2<UInt32>: UInt32] = [:]

  init(positions: [SIMD3<Float>], values: [Float]) {
    self.positions = positions
    self.values = values
  }

  mutating func snap(_ triangles: [Triangle], share: Float) {
    for triangle in triangles {
      for (a, b) in [
        (triangle.a, triangle.b), (triangle.b, triangle.c), (triangle.c, triangle.a),
      ] where values[Int(a)] * values[Int(b)] < 0 {
        let part = crossing(a, b)
        guard let moved = part < share ? a : part > 1 - share ? b : nil else { continue }
        positions[Int(moved)] = position(a, b, part)
        values[Int(moved)] = 0
      }
    }
  }

  mutating func add(_ triangle: Triangle) {
    let corners = triangle.vertices.map { UInt32($0) }
    let signs = corners.map { values[Int($0)].signum }
    guard signs.contains(1), signs.contains(-1) else {
      triangles.append(triangle)
      return
    }
    /// The corners from number `first` on, in their order.
    func rotated(_ first: Int) -> (UInt32, UInt32, UInt32) {
      (corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3])
    }
    if let zero = signs.firstIndex(of: 0) {
      let (a, b, c) = rotated(zero)
      let m = vertex(b, c)
      triangles += [Triangle(a, b, m), Triangle(a, m, c)]
    } else {
      let isAlone = signs.map { $0 != (signs.reduce(0, +) > 0 ? 1 : -1) }
      let (a, b, c) = rotated(isAlone.firstIndex(of: true) ?? 0)
      let (m, n) = (vertex(a, b), vertex(a, c))
      triangles += [Triangle(a, m, n), Triangle(m, b, c), Triangle(m, c, n)]
    }
  }

  /// The vertex where the edge between two vertices on different sides crosses the line.
  private mutating func vertex(_ a: UInt32, _ b: UInt32) -> UInt32 {
    let (low, high) = (min(a, b), max(a, b))
    if let found = crossings[[low, high]] { return found }
    let index = UInt32(positions.count)
    positions.append(position(low, high, crossing(low, high)))
    values.append(0)
    crossings[[low, high]] = index
    return index
  }

  /// Where the line crosses an edge, as a share of its length from `a`.
  private func crossing(_ a: UInt32, _ b: UInt32) -> Float {
    values[Int(a)] / (values[Int(a)] - values[Int(b)])
  }

  private func position(_ a: UInt32, _ b: UInt32, _ part: Float) -> SIMD3<Float> {
    positions[Int(a)] + part * (positions[Int(b)] - positions[Int(a)])
  }
}

extension Float {
  /// −1, 0 or 1.
  fileprivate var signum: Int { self > 0 ? 1 : self < 0 ? -1 : 0 }
}
