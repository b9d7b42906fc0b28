/// The triangles of one atlas with a single index per vertex, as required by glTF and GPUs: one
/// vertex per position, split only where texture coordinates differ.
package struct IndexedTriangles: Sendable {
  /// For each vertex, its index into the mesh's positions and normals, in order of first use.
  package private(set) var positions: [UInt32] = []
  /// For each vertex, its index into the texture coordinates; empty without texture.
  package private(set) var coordinates: [UInt32] = []
  /// Three vertex indices per triangle.
  package private(set) var indices: [UInt32] = []

  /// For each position its latest vertex, and for each vertex the previous one at the same
  /// position.
  private var first: [UInt32]
  private var next: [UInt32] = []
  private static let none = UInt32.max

  /// Indexes the triangles of `mesh` in the given range.
  package init(_ mesh: TexturedMesh, triangles range: Range<Int>) {
    let hasTexture = mesh.textureTriangles.count == mesh.mesh.triangles.count
    first = [UInt32](repeating: Self.none, count: mesh.mesh.positions.count)
    indices.reserveCapacity(3 * range.count)
    for index in range {
      let t = mesh.mesh.triangles[index]
      let st = hasTexture ? mesh.textureTriangles[index] : nil
      indices.append(vertex(t.a, st?.a))
      indices.append(vertex(t.b, st?.b))
      indices.append(vertex(t.c, st?.c))
    }
    (first, next) = ([], [])
  }

  private mutating func vertex(_ position: UInt32, _ coordinate: UInt32?) -> UInt32 {
    var vertex = first[Int(position)]
    while vertex != Self.none {
      guard let coordinate, coordinates[Int(vertex)] != coordinate else { return vertex }
      vertex = next[Int(vertex)]
    }
    vertex = UInt32(positions.count)
    positions.append(position)
    if let coordinate { coordinates.append(coordinate) }
    next.append(first[Int(position)])
    first[Int(position)] = vertex
    return vertex
  }
}
