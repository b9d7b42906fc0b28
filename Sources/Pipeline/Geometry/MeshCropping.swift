import SceneModel

/// Clips a surface at the faces of a box (after Sutherland and Hodgman, "Reentrant polygon
/// clipping", CACM 1974). The cut stays open.
struct MeshCropping: Sendable {
  /// The part inside the box, and the rest that may occlude it.
  struct Parts: Sendable {
    var inside: Mesh
    /// Triangles clearly outside the box: they may occlude the part inside.
    var outside: Mesh
  }

  /// Shares of the diagonal of the box or the surface, whichever is smaller: points within
  /// `tolerance` of a face count as on it; outside triangles keep a distance of `clearance`.
  /// Chosen: the first is a few steps of single precision.
  private static let (tolerance, clearance): (Float, Float) = (1e-6, 0.005)

  var box: OrientedBox

  /// A surface entirely inside is returned unchanged.
  func run(_ mesh: Mesh) -> Parts {
    let extent = mesh.bounds.map { ($0.max - $0.min).length } ?? 0
    let diagonal = min(2 * box.halfExtents.length, extent)
    let planes = Self.planes(of: box)
    let tolerance = Self.tolerance * diagonal
    if planes.allSatisfy({ plane in mesh.positions.allSatisfy { plane.distance($0) <= tolerance } })
    {
      return Parts(inside: mesh, outside: Mesh())
    }
    let inside = planes.reduce(mesh) { Self.clipped($0, by: $1, tolerance: tolerance) }
    let far = Self.planes(of: box.grown(by: Self.clearance * diagonal))
    let isFar = mesh.positions.map { p in far.contains { $0.distance(p) > 0 } }
    var outside = Mesh(positions: mesh.positions, triangles: mesh.triangles)
    outside.triangles.removeAll { !$0.vertices.allSatisfy { isFar[$0] } }
    return Parts(inside: inside.withoutUnusedVertices(), outside: outside.withoutUnusedVertices())
  }

  private struct Plane {
    /// Outward.
    var normal: SIMD3<Float>
    var offset: Float

    /// Signed; positive outside.
    func distance(_ point: SIMD3<Float>) -> Float { normal.dot(point) - offset }
  }

  private static func planes(of box: OrientedBox) -> [Plane] {
    box.axes.enumerated().flatMap { index, axis in
      let (middle, half) = (axis.dot(box.center), box.halfExtents[index])
      return [
        Plane(normal: axis, offset: middle + half), Plane(normal: -axis, offset: half - middle),
      ]
    }
  }

  private static func clipped(_ mesh: Mesh, by plane: Plane, tolerance: Float) -> Mesh {
    var cut = Cut(mesh, plane, tolerance: tolerance)
    for triangle in mesh.triangles { cut.add(triangle) }
    return cut.result
  }

  /// A mesh clipped at a plane, triangle by triangle.
  private struct Cut {
    var result: Mesh
    /// Signed distances of the vertices; zero on the plane.
    private var distances: [Float]
    /// New vertices by the edge that they split, lower index first, shared between triangles.
    private var divided: [SIMD2<UInt32>: UInt32] = [:]

    init(_ mesh: Mesh, _ plane: Plane, tolerance: Float) {
      result = mesh
      result.triangles = []
      distances = mesh.positions.map {
        let distance = plane.distance($0)
        return abs(distance) <= tolerance ? 0 : distance
      }
    }

    mutating func add(_ triangle: Triangle) {
      let corners = [triangle.a, triangle.b, triangle.c]
      guard corners.contains(where: { distances[Int($0)] > 0 }) else {
        result.triangles.append(triangle)
        return
      }
      guard corners.contains(where: { distances[Int($0)] < 0 }) else { return }
      var polygon: [UInt32] = []
      for (index, corner) in corners.enumerated() {
        let next = corners[(index + 1) % 3]
        if distances[Int(corner)] <= 0 { polygon.append(corner) }
        if distances[Int(corner)] * distances[Int(next)] < 0 {
          polygon.append(divide(corner, next))
        }
      }
      append(polygon)
    }

    /// Appends a polygon of three or four corners; four are split along the shorter diagonal.
    private mutating func append(_ polygon: [UInt32]) {
      guard polygon.count >= 3 else { return }
      guard polygon.count == 4 else {
        result.triangles.append(Triangle(polygon[0], polygon[1], polygon[2]))
        return
      }
      let p = polygon.map { result.positions[Int($0)] }
      let first = (p[2] - p[0]).squaredLength <= (p[3] - p[1]).squaredLength ? 0 : 1
      let q = (0..<4).map { polygon[(first + $0) % 4] }
      result.triangles += [Triangle(q[0], q[1], q[2]), Triangle(q[0], q[2], q[3])]
    }

    /// The vertex where the plane intersects an edge.
    private mutating func divide(_ a: UInt32, _ b: UInt32) -> UInt32 {
      let edge = SIMD2(min(a, b), max(a, b))
      if let vertex = divided[edge] { return vertex }
      let (low, high) = (Int(edge.x), Int(edge.y))
      let share = distances[low] / (distances[low] - distances[high])
      let vertex = UInt32(result.positions.count)
      divided[edge] = vertex
      result.positions.append(mix(result.positions[low], result.positions[high], share))
      if !result.normals.isEmpty {
        result.normals.append(mix(result.normals[low], result.normals[high], share).normalized)
      }
      if !result.colors.isEmpty {
        let color = mix(
          SIMD3<Float>(result.colors[low]), SIMD3<Float>(result.colors[high]), share)
        result.colors.append(SIMD3<UInt8>(color.rounded(.toNearestOrAwayFromZero)))
      }
      distances.append(0)
      return vertex
    }

    private func mix(_ a: SIMD3<Float>, _ b: SIMD3<Float>, _ share: Float) -> SIMD3<Float> {
      a + (b - a) * share
    }
  }
}
