import SceneModel

/// A self-contained mesh with the triangles of one atlas.
package struct MeshPart: Equatable, Sendable {
  /// World frame.
  package var positions: [SIMD3<Float>] = []
  /// One per position; empty if the mesh has none.
  package var normals: [SIMD3<Float>] = []
  /// Origin at the bottom left.
  package var textureCoordinates: [SIMD2<Float>] = []
  /// Indices into `positions`.
  package var triangles: [Triangle] = []
  /// Indices into `textureCoordinates`, parallel to `triangles`; empty without texture.
  package var textureTriangles: [Triangle] = []
  /// Number of quads, each formed by two of the first triangles; see `TextureAtlas`.
  package var quadCount = 0

  /// All of `mesh`, unchanged.
  init(whole mesh: TexturedMesh) {
    positions = mesh.mesh.positions
    normals = mesh.mesh.normals
    textureCoordinates = mesh.textureCoordinates
    triangles = mesh.mesh.triangles
    textureTriangles = mesh.textureTriangles
    quadCount = mesh.atlases.first?.quadCount ?? 0
  }

  /// The triangles of `atlas` with the vertices and coordinates that they use, renumbered in order
  /// of first use.
  init(_ mesh: TexturedMesh, of atlas: TextureAtlas) {
    quadCount = atlas.quadCount
    var vertices = Renumbering(count: mesh.mesh.positions.count)
    var coordinates = Renumbering(count: mesh.textureCoordinates.count)
    for index in atlas.triangles {
      triangles.append(vertices.triangle(mesh.mesh.triangles[index]))
      textureTriangles.append(coordinates.triangle(mesh.textureTriangles[index]))
    }
    positions = vertices.order.map { mesh.mesh.positions[$0] }
    if mesh.mesh.normals.count == mesh.mesh.positions.count {
      normals = vertices.order.map { mesh.mesh.normals[$0] }
    }
    textureCoordinates = coordinates.order.map { mesh.textureCoordinates[$0] }
  }
}

/// Renumbers indices in order of their first use.
private struct Renumbering {
  private(set) var order: [Int] = []
  private var numbers: [UInt32]

  init(count: Int) { numbers = [UInt32](repeating: .max, count: count) }

  mutating func triangle(_ t: Triangle) -> Triangle {
    Triangle(number(t.a), number(t.b), number(t.c))
  }

  private mutating func number(_ index: UInt32) -> UInt32 {
    if numbers[Int(index)] == .max {
      numbers[Int(index)] = UInt32(order.count)
      order.append(Int(index))
    }
    return numbers[Int(index)]
  }
}
