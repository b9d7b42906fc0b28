import SceneModel

/// Tangents at the corners as viewers derive them from texture coordinates: those of the triangles,
/// weighted by the angle at the vertex, merged within a chart (Mikkelsen's tangent space).
struct TangentFrames: Sendable {
  /// `texels` holds texture coordinates with y down, three per triangle. The fourth component of
  /// the result is the sign of the bitangent, which points up in the texture.
  func run(_ mesh: Mesh, texels: [SIMD2<Float>], charts: [Int32]) -> [SIMD4<Float>] {
    // Few charts meet at a vertex: lists are shorter than dictionaries.
    var sums = [[(chart: Int32, sum: SIMD3<Float>)]](repeating: [], count: mesh.positions.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      let tangent = Self.tangent(mesh, face, texels)
      for (corner, vertex) in triangle.vertices.enumerated() {
        let normal = mesh.normals[vertex]
        let flat = (tangent - normal * normal.dot(tangent)).normalized
        let weighted = flat * Self.angle(mesh, triangle.vertices, corner)
        if let place = sums[vertex].firstIndex(where: { $0.chart == charts[face] }) {
          sums[vertex][place].sum += weighted
        } else {
          sums[vertex].append((charts[face], weighted))
        }
      }
    }
    var result: [SIMD4<Float>] = []
    result.reserveCapacity(texels.count)
    for (face, triangle) in mesh.triangles.enumerated() {
      for vertex in triangle.vertices {
        let sum = sums[vertex].first { $0.chart == charts[face] }?.sum ?? .zero
        let unit = sum.normalized
        // Charts are never mirrored, so the frame is right-handed everywhere.
        result.append(SIMD4(unit, 1))
      }
    }
    return result
  }

  /// The direction in space of increasing u.
  private static func tangent(
    _ mesh: Mesh, _ face: Int, _ texels: [SIMD2<Float>]
  ) -> SIMD3<Float> {
    let (a, b, c) = mesh.corners(of: mesh.triangles[face])
    let (t, r, s) = (texels[3 * face], texels[3 * face + 1], texels[3 * face + 2])
    let (e1, e2) = (r - t, s - t)
    let determinant = e1.x * e2.y - e1.y * e2.x
    guard abs(determinant) > 1e-12 else { return (b - a).normalized }
    return (((b - a) * e2.y - (c - a) * e1.y) / determinant).normalized
  }

  private static func angle(_ mesh: Mesh, _ vertices: Triple<Int>, _ corner: Int) -> Float {
    let p = mesh.positions[vertices[corner]]
    return Mesh.angle(
      mesh.positions[vertices[(corner + 1) % 3]] - p,
      mesh.positions[vertices[(corner + 2) % 3]] - p)
  }
}
