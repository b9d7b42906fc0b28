import SceneModel

/// A part of a surface whose free vertices move to the mean of their neighbors: the solution of
/// Laplace's equation on the mesh graph, by conjugate gradients.
struct MembraneFill: Sendable {
  /// The free vertices, by mesh index.
  private(set) var vertices: [Int] = []
  /// Neighbors of each free vertex: free ones by index in `vertices`, fixed ones as −1 − vertex.
  private var offsets: [Int] = [0]
  private var neighbors: [Int] = []

  /// `isFixed` has a value for each vertex of the mesh.
  init(_ triangles: [Triangle], isFixed: [Bool]) {
    var edges: [SIMD2<UInt32>] = []
    edges.reserveCapacity(6 * triangles.count)
    for edge in triangles.lazy.flatMap(\.edges) {
      if !isFixed[Int(edge.x)] { edges.append(edge) }
      if !isFixed[Int(edge.y)] { edges.append([edge.y, edge.x]) }
    }
    edges.sort { ($0.x, $0.y) < ($1.x, $1.y) }
    var indices: [UInt32: Int] = [:]
    for edge in edges where indices[edge.x] == nil {
      indices[edge.x] = vertices.count
      vertices.append(Int(edge.x))
    }
    var last: SIMD2<UInt32>?
    for edge in edges where edge != last {
      if let last, last.x != edge.x { offsets.append(neighbors.count) }
      neighbors.append(indices[edge.y] ?? -1 - Int(edge.y))
      last = edge
    }
    if !vertices.isEmpty { offsets.append(neighbors.count) }
  }

  /// Moves the free vertices to the solution; `iterations` is the maximum number of CG iterations.
  func relax(_ positions: inout [SIMD3<Float>], iterations: Int) {
    guard !vertices.isEmpty else { return }
    var x = vertices.map { SIMD3<Double>(positions[$0]) }
    var residual = vertices.indices.map { laplacianResidual($0, x, positions) }
    var direction = residual
    var squaredNorm = Self.dot(residual, residual)
    let tolerance = squaredNorm * 1e-10
    for _ in 0..<iterations {
      guard squaredNorm.max() > tolerance.max() else { break }
      let product = vertices.indices.map { laplacian($0, direction) }
      let step = Self.ratio(squaredNorm, Self.dot(direction, product))
      for i in vertices.indices {
        x[i] += step * direction[i]
        residual[i] -= step * product[i]
      }
      let next = Self.dot(residual, residual)
      let beta = Self.ratio(next, squaredNorm)
      for i in vertices.indices { direction[i] = residual[i] + beta * direction[i] }
      squaredNorm = next
    }
    for (index, vertex) in vertices.enumerated() { positions[vertex] = SIMD3<Float>(x[index]) }
  }

  /// The residual of a vertex: the sum of differences from it to its neighbors.
  private func laplacianResidual(
    _ index: Int, _ x: [SIMD3<Double>], _ positions: [SIMD3<Float>]
  ) -> SIMD3<Double> {
    neighbors[offsets[index]..<offsets[index + 1]].reduce(SIMD3<Double>.zero) {
      $0 + ($1 >= 0 ? x[$1] : SIMD3<Double>(positions[-1 - $1])) - x[index]
    }
  }

  /// One row of the graph Laplacian of the free vertices times a vector.
  private func laplacian(_ index: Int, _ vector: [SIMD3<Double>]) -> SIMD3<Double> {
    let range = offsets[index]..<offsets[index + 1]
    return neighbors[range].reduce(Double(range.count) * vector[index]) {
      $1 >= 0 ? $0 - vector[$1] : $0
    }
  }

  /// The scalar products of the three coordinates, each a separate linear system.
  private static func dot(_ a: [SIMD3<Double>], _ b: [SIMD3<Double>]) -> SIMD3<Double> {
    zip(a, b).reduce(SIMD3<Double>.zero) { $0 + $1.0 * $1.1 }
  }

  /// Component-wise a / b; 0 where b isn't positive.
  private static func ratio(_ a: SIMD3<Double>, _ b: SIMD3<Double>) -> SIMD3<Double> {
    let isZero = b .<= 0
    return (a / b.replacing(with: 1, where: isZero)).replacing(with: 0, where: isZero)
  }
}
