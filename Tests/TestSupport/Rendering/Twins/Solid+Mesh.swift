import Kernels
import SceneModel

/// A closed mesh of a solid, without hidden surfaces inside.
extension Solid {
  /// Dual contouring (Ju et al., 2002), which keeps sharp edges.
  ///
  /// - Parameters:
  ///   - low: a corner of a box that contains the solid.
  ///   - high: the opposite corner.
  ///   - cell: width of the cells, each of which contributes a vertex.
  func mesh(
    from low: SIMD3<Float>, to high: SIMD3<Float>, cell: Float, _ control: KernelControl
  ) throws -> Mesh {
    let lattice = Lattice(from: low, to: high, cell: cell)
    let values = try lattice.sample(self, control)
    let layers = try control.parallelMap(lattice.count.z - 1) { z in
      contour(lattice, values, layer: z)
    }
    var mesh = Mesh()
    var vertices = [Int32](repeating: -1, count: values.count)
    for vertex in layers.joined() {
      vertices[vertex.cell] = Int32(mesh.positions.count)
      mesh.positions.append(vertex.position)
    }
    mesh.triangles = lattice.triangles(values, vertices, mesh.positions)
    return mesh.deformed()
  }

  /// The vertices of the cells of a layer that the surface passes through.
  private func contour(
    _ lattice: Lattice, _ values: [Float], layer z: Int
  ) -> [(cell: Int, position: SIMD3<Float>)] {
    var vertices: [(cell: Int, position: SIMD3<Float>)] = []
    for y in 0..<lattice.count.y - 1 {
      for x in 0..<lattice.count.x - 1 {
        let cell = lattice.index(SIMD3(x, y, z))
        let first = values[cell] < 0
        guard lattice.corners.contains(where: { (values[cell + $0] < 0) != first }) else {
          continue
        }
        vertices.append((cell, vertex(lattice, values, SIMD3(x, y, z))))
      }
    }
    return vertices
  }

  /// The point with the least distances from the tangent planes where the surface crosses the
  /// edges of a cell.
  private func vertex(
    _ lattice: Lattice, _ values: [Float], _ cell: SIMD3<Int>
  ) -> SIMD3<Float> {
    let crossings = lattice.edges.compactMap { a, b -> SIMD3<Float>? in
      let (from, to) = (values[lattice.index(cell &+ a)], values[lattice.index(cell &+ b)])
      guard (from < 0) != (to < 0) else { return nil }
      let (start, end) = (lattice.point(cell &+ a), lattice.point(cell &+ b))
      return start + (end - start) * (from / (from - to))
    }
    let middle = crossings.reduce(.zero, +) / Float(crossings.count)
    // Keeps the vertex in the middle along directions that the planes leave open.
    let weight: Float = 0.03
    var x = SIMD3(weight, 0, 0)
    var y = SIMD3(0, weight, 0)
    var z = SIMD3(0, 0, weight)
    var right = SIMD3<Float>.zero
    for crossing in crossings {
      let n = normal(at: crossing, step: 0.02 * lattice.cell)
      x += n * n.x
      y += n * n.y
      z += n * n.z
      right += n * n.dot(crossing - middle)
    }
    let determinant = x.dot(y.cross(z))
    let offset =
      SIMD3(right.dot(y.cross(z)), right.dot(z.cross(x)), right.dot(x.cross(y))) / determinant
    let (low, high) = (lattice.point(cell), lattice.point(cell &+ 1))
    return (middle + offset).clamped(lowerBound: low, upperBound: high)
  }
}
