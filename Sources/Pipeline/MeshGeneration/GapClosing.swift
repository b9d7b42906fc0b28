import Foundation
import SceneModel

/// Closes the gaps that trimming leaves, but for those that photos look through.
///
/// Poisson's own surface closes a small gap best. Over a large one it bulges like a balloon; there
/// it is drawn taut, each vertex at the mean of its neighbours: a membrane across the gap. What of it
/// is close above the support of an object stood on it and is laid down there.
struct GapClosing {
  struct Options: Hashable, Codable, Sendable {
    /// Close gaps of any size, as of an object, which has an inside.
    var closesLarge = true
    /// A gap of less than this share of the surface's size across is small.
    var smallShare = 0.05
    /// One of less than this is closed whatever photos look through: the way through an object that
    /// they show is not a hole in its skin.
    var tinyShare = 0.015
    /// The share of a gap's area that photos may look through for it to be closed.
    var smallFreeShare = 0.05
    /// The same for a membrane.
    var membraneFreeShare = 0.2
    /// How far behind a gap it is seen whether photos look through it, in world units: a ray that
    /// grazes the surface doesn't get there.
    var depth: Float = 0
    /// What is lower than this share of the object's height above its support touched it.
    var contactShare = 0.02
    /// Iterations of the solver at most, for a membrane.
    var iterations = 400

    init() {}
  }

  var options = Options()

  /// Drops the faces for which `isRemoved` says so, less those that close a gap. `isFree` tells
  /// whether photos look through a place; `support` is what the object stands on, if anything.
  func run(
    _ mesh: Mesh, isRemoved: [Bool], support: StandingPlane? = nil,
    isFree: (SIMD3<Float>) -> Bool
  ) -> Mesh {
    guard let bounds = mesh.bounds, isRemoved.contains(true) else { return mesh }
    let size = (bounds.max - bounds.min).length
    // What bulges out of the solved cube ends there: with a lid on, it closes a gap, too.
    let lid = mesh.lid(isRemoved: isRemoved)
    let (mesh, isRemoved) = (mesh.adding(lid), isRemoved + lid.triangles.map { _ in true })
    let gaps = Gaps(mesh, isRemoved: isRemoved)
    let contact = support.map { Contact($0, under: mesh, isRemoved, share: options.contactShare) }
    var (result, isDropped) = (mesh, isRemoved)
    for gap in 0..<gaps.count where gaps.isEnclosed[gap] {
      let faces = gaps.faces(of: gap)
      let triangles = faces.map { mesh.triangles[$0] }
      let share = mesh.extent(of: triangles).map { Double($0 / size) } ?? 1
      let isSmall = share < options.smallShare
      // A balloon with more surface than what holds it is no gap: stray samples made it.
      if isSmall || !options.closesLarge, mesh.area(of: triangles) > gaps.rimArea[gap] { continue }
      let isTiny = share < options.tinyShare && options.closesLarge
      if isSmall,
        result.freeShare(of: triangles, depth: options.depth, isFree) < options.smallFreeShare
      {
        for face in faces { isDropped[face] = false }
      } else if isSmall || options.closesLarge {
        tighten(triangles, of: &result, gaps.isRim, contact)
        guard
          isTiny
            || result.freeShare(of: triangles, depth: options.depth, isFree)
              < options.membraneFreeShare
        else {
          continue
        }
        for face in faces { isDropped[face] = false }
      }
    }
    result.triangles = mesh.triangles.indices.filter { !isDropped[$0] }.map { mesh.triangles[$0] }
    return result
  }

  /// Draws a membrane across a gap and lays down on the support what is close above it.
  private func tighten(
    _ triangles: [Triangle], of mesh: inout Mesh, _ isRim: [Bool], _ contact: Contact?
  ) {
    let membrane = Membrane(triangles, isFixed: isRim)
    membrane.tighten(&mesh.positions, iterations: options.iterations)
    guard let contact else { return }
    var isFixed = isRim
    for vertex in membrane.vertices where contact.lay(&mesh.positions[vertex]) {
      isFixed[vertex] = true
    }
    Membrane(triangles, isFixed: isFixed).tighten(&mesh.positions, iterations: options.iterations)
  }
}

/// Where an object touches its support.
private struct Contact {
  private let plane: StandingPlane
  private let limit: Double

  init(_ plane: StandingPlane, under mesh: Mesh, _ isRemoved: [Bool], share: Double) {
    self.plane = plane
    var top = 0.0
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) where !isRemoved {
      top = max(top, plane.height(of: SIMD3<Double>(mesh.positions[Int(triangle.a)])))
    }
    limit = max(2 * plane.band, share * top)
  }

  /// Puts a point that is close to the support down on it.
  func lay(_ point: inout SIMD3<Float>) -> Bool {
    let height = plane.height(of: SIMD3<Double>(point))
    guard height < limit else { return false }
    point = SIMD3<Float>(SIMD3<Double>(point) - height * plane.normal)
    return true
  }
}

/// The removed faces of a mesh by the gap that they close.
private struct Gaps {
  let count: Int
  /// Whether the kept faces go all around a gap.
  let isEnclosed: [Bool]
  /// Vertices between kept and removed faces.
  let isRim: [Bool]
  /// The area of the largest connected part that a gap borders on.
  let rimArea: [Double]
  private let removed: [Int]
  private let members: Members

  init(_ mesh: Mesh, isRemoved: [Bool]) {
    removed = isRemoved.indices.filter { isRemoved[$0] }
    var isKept = [Bool](repeating: false, count: mesh.positions.count)
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) where !isRemoved {
      for vertex in triangle.vertices { isKept[vertex] = true }
    }
    isRim = isKept
    // Gaps that meet at a vertex only are two: faces of one have edges in common.
    var numbers: [SIMD2<UInt32>: UInt32] = [:]
    let byEdges = removed.map { face in
      let edges = mesh.triangles[face].edges.map { edge -> UInt32 in
        let key = SIMD2(min(edge.x, edge.y), max(edge.x, edge.y))
        let number = numbers[key] ?? UInt32(numbers.count)
        numbers[key] = number
        return number
      }
      return Triangle(edges[0], edges[1], edges[2])
    }
    let components = MeshComponents(byEdges, vertexCount: numbers.count)
    count = components.count
    members = Members(of: components.components, count: components.count)
    isEnclosed = Self.areEnclosed(mesh, removed, components, isKept)
    rimArea = Self.rimAreas(mesh, isRemoved, removed, components)
  }

  private static func rimAreas(
    _ mesh: Mesh, _ isRemoved: [Bool], _ removed: [Int], _ gaps: MeshComponents
  ) -> [Double] {
    let kept = mesh.triangles.indices.filter { !isRemoved[$0] }.map { mesh.triangles[$0] }
    let parts = MeshComponents(kept, vertexCount: mesh.positions.count)
    var areas = [Double](repeating: 0, count: parts.count)
    var partOfVertex = [Int32](repeating: -1, count: mesh.positions.count)
    for (triangle, part) in zip(kept, parts.components) {
      areas[Int(part)] += mesh.area(of: [triangle])
      for vertex in triangle.vertices { partOfVertex[vertex] = part }
    }
    var result = [Double](repeating: 0, count: gaps.count)
    for (face, gap) in zip(removed, gaps.components) {
      for vertex in mesh.triangles[face].vertices where partOfVertex[vertex] >= 0 {
        result[Int(gap)] = max(result[Int(gap)], areas[Int(partOfVertex[vertex])])
      }
    }
    return result
  }

  func faces(of gap: Int) -> [Int] { members[gap].map { removed[Int($0)] } }

  /// A gap is enclosed when it has a rim and all of its edges have a face on both sides.
  private static func areEnclosed(
    _ mesh: Mesh, _ removed: [Int], _ components: MeshComponents, _ isKept: [Bool]
  ) -> [Bool] {
    let open = mesh.openEdges
    var hasRim = [Bool](repeating: false, count: components.count)
    var isOpen = hasRim
    for (face, gap) in zip(removed, components.components) {
      let triangle = mesh.triangles[face]
      if triangle.vertices.contains(where: { isKept[$0] }) { hasRim[Int(gap)] = true }
      if triangle.edges.contains(where: open.contains) { isOpen[Int(gap)] = true }
    }
    return zip(hasRim, isOpen).map { $0 && !$1 }
  }
}

/// A part of a surface whose free vertices are drawn to the mean of their neighbours: the solution of
/// Laplace's equation on its graph, by conjugate gradients.
private struct Membrane {
  /// The free vertices, by their number in the mesh.
  private(set) var vertices: [Int] = []
  /// Neighbours of each free vertex: free ones by their place in `vertices`, fixed ones as −1 − vertex.
  private var offsets: [Int] = [0]
  private var neighbours: [Int] = []

  init(_ triangles: [Triangle], isFixed: [Bool]) {
    let edges = triangles.flatMap(\.edges).flatMap { [$0, SIMD2($0.y, $0.x)] }
      .filter { !isFixed[Int($0.x)] }
      .sorted { ($0.x, $0.y) < ($1.x, $1.y) }
    var places: [UInt32: Int] = [:]
    for edge in edges where places[edge.x] == nil {
      places[edge.x] = vertices.count
      vertices.append(Int(edge.x))
    }
    var last: SIMD2<UInt32>?
    for edge in edges where edge != last {
      if let last, last.x != edge.x { offsets.append(neighbours.count) }
      neighbours.append(places[edge.y] ?? -1 - Int(edge.y))
      last = edge
    }
    if !vertices.isEmpty { offsets.append(neighbours.count) }
  }

  /// Moves the free vertices.
  func tighten(_ positions: inout [SIMD3<Float>], iterations: Int) {
    guard !vertices.isEmpty else { return }
    var x = vertices.map { SIMD3<Double>(positions[$0]) }
    var residual = vertices.indices.map { pull($0, x, positions) }
    var direction = residual
    var energy = Self.dot(residual, residual)
    let enough = energy * 1e-10
    for _ in 0..<iterations {
      guard energy.max() > enough.max() else { break }
      let product = vertices.indices.map { applied($0, direction) }
      let step = Self.ratio(energy, Self.dot(direction, product))
      for i in vertices.indices {
        x[i] += step * direction[i]
        residual[i] -= step * product[i]
      }
      let next = Self.dot(residual, residual)
      let turn = Self.ratio(next, energy)
      for i in vertices.indices { direction[i] = residual[i] + turn * direction[i] }
      energy = next
    }
    for (place, vertex) in vertices.enumerated() { positions[vertex] = SIMD3<Float>(x[place]) }
  }

  /// The sum over the neighbours of their difference to a vertex.
  private func pull(
    _ place: Int, _ x: [SIMD3<Double>], _ positions: [SIMD3<Float>]
  ) -> SIMD3<Double> {
    neighbours[offsets[place]..<offsets[place + 1]].reduce(SIMD3<Double>.zero) {
      $0 + ($1 >= 0 ? x[$1] : SIMD3<Double>(positions[-1 - $1])) - x[place]
    }
  }

  /// The graph Laplacian of the free vertices times a vector.
  private func applied(_ place: Int, _ vector: [SIMD3<Double>]) -> SIMD3<Double> {
    let range = offsets[place]..<offsets[place + 1]
    return neighbours[range].reduce(Double(range.count) * vector[place]) {
      $1 >= 0 ? $0 - vector[$1] : $0
    }
  }

  /// The scalar products of the three coordinates, each a system of its own.
  private static func dot(_ a: [SIMD3<Double>], _ b: [SIMD3<Double>]) -> SIMD3<Double> {
    zip(a, b).reduce(SIMD3<Double>.zero) { $0 + $1.0 * $1.1 }
  }

  private static func ratio(_ a: SIMD3<Double>, _ b: SIMD3<Double>) -> SIMD3<Double> {
    let isZero = b .<= 0
    return (a / b.replacing(with: 1, where: isZero)).replacing(with: 0, where: isZero)
  }
}

extension Mesh {
  /// A fan over each border of removed faces; its vertices beyond the surface's own are the middles.
  fileprivate func lid(isRemoved: [Bool]) -> (middles: [SIMD3<Float>], triangles: [Triangle]) {
    let open = openEdges
    var next: [UInt32: UInt32] = [:]
    for (triangle, isRemoved) in zip(triangles, isRemoved) where isRemoved {
      for edge in triangle.edges where open.contains(edge) { next[edge.x] = edge.y }
    }
    var result: (middles: [SIMD3<Float>], triangles: [Triangle]) = ([], [])
    for start in next.keys.sorted() {
      var border: [UInt32] = []
      var vertex = start
      while let following = next.removeValue(forKey: vertex) {
        border.append(vertex)
        vertex = following
      }
      guard vertex == start, border.count > 2 else { continue }
      let middle = UInt32(positions.count + result.middles.count)
      let sum = border.reduce(SIMD3<Float>.zero) { $0 + positions[Int($1)] }
      result.middles.append(sum / Float(border.count))
      result.triangles += zip(border, border.dropFirst() + [start]).map { Triangle($1, $0, middle) }
    }
    return result
  }

  /// The edges that have a face on their left only.
  fileprivate var openEdges: Set<SIMD2<UInt32>> {
    var open = Set<SIMD2<UInt32>>()
    for triangle in triangles {
      for edge in triangle.edges where open.remove([edge.y, edge.x]) == nil { open.insert(edge) }
    }
    return open
  }

  fileprivate func adding(_ lid: (middles: [SIMD3<Float>], triangles: [Triangle])) -> Mesh {
    var mesh = self
    mesh.positions += lid.middles
    mesh.triangles += lid.triangles
    return mesh
  }

  fileprivate func area(of faces: [Triangle]) -> Double {
    faces.reduce(0) { sum, face in
      let (a, b, c) = corners(of: face)
      return sum + Double((b - a).cross(c - a).length) / 2
    }
  }

  /// The share of some faces' area that photos look through.
  fileprivate func freeShare(
    of faces: [Triangle], depth: Float, _ isFree: (SIMD3<Float>) -> Bool
  ) -> Double {
    var (free, all) = (0.0, 0.0)
    for face in faces {
      let (a, b, c) = corners(of: face)
      let normal = (b - a).cross(c - a)
      let area = Double(normal.length)
      all += area
      if isFree(center(of: face) - depth * normal.normalized) { free += area }
    }
    return all > 0 ? free / all : 0
  }

  /// The diagonal of the box around some faces.
  fileprivate func extent(of faces: [Triangle]) -> Float? {
    Mesh(positions: faces.map { center(of: $0) }).bounds.map { ($0.max - $0.min).length }
  }
}

extension Triangle {
  fileprivate var edges: [SIMD2<UInt32>] { [[a, b], [b, c], [c, a]] }
}
