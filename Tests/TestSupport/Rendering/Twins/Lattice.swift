import Kernels
import SceneModel

/// The points of a cubic lattice at which a solid is sampled.
struct Lattice: Sendable {
  let origin: SIMD3<Float>
  let cell: Float
  let count: SIMD3<Int>
  /// Offsets of the indices of a cell's corners.
  let corners: [Int]
  /// The ends of a cell's edges.
  let edges: [(SIMD3<Int>, SIMD3<Int>)]

  /// Points per side of the blocks of which only those near the surface are sampled.
  private static let block = 8

  init(from low: SIMD3<Float>, to high: SIMD3<Float>, cell: Float) {
    self.cell = cell
    // Planes of a shape rarely coincide with those of the lattice.
    origin = low - cell * SIMD3(2.37, 2.41, 2.43)
    let size = ((high - low) / cell).rounded(.up)
    let count = SIMD3(Int(size.x), Int(size.y), Int(size.z)) &+ 6
    self.count = count
    let ends = (0..<8).map { SIMD3($0 & 1, $0 >> 1 & 1, $0 >> 2) }
    corners = ends.map { $0.x + count.x * ($0.y + count.y * $0.z) }
    edges = ends.flatMap { end in
      (0..<3).filter { end[$0] == 0 }.map { axis in
        var other = end
        other[axis] = 1
        return (end, other)
      }
    }
  }

  func index(_ place: SIMD3<Int>) -> Int { place.x + count.x * (place.y + count.y * place.z) }

  func point(_ place: SIMD3<Int>) -> SIMD3<Float> {
    origin + SIMD3(Float(place.x), Float(place.y), Float(place.z)) * cell
  }

  /// The distances at all points; far from the surface, those in the middle of the block.
  func sample(_ solid: Solid, _ control: KernelControl) throws -> [Float] {
    let size = Self.block
    let slabs = try control.parallelMap((count.z + size - 1) / size) { slab in
      let (first, last) = (slab * size, min(count.z, (slab + 1) * size))
      var values = [Float](repeating: 0, count: count.x * count.y * (last - first))
      for y in stride(from: 0, to: count.y, by: size) {
        for x in stride(from: 0, to: count.x, by: size) {
          let low = SIMD3(x, y, first)
          let high = SIMD3(min(x + size, count.x), min(y + size, count.y), last)
          fill(&values, solid, low, high)
        }
      }
      return values
    }
    return slabs.flatMap { $0 }
  }

  private func fill(
    _ values: inout [Float], _ solid: Solid, _ low: SIMD3<Int>, _ high: SIMD3<Int>
  ) {
    let reach = Float(Self.block) * cell
    let middle = solid.distance(point(low) + reach / 2)
    // Twice the half diagonal, because the distances are only bounds.
    let isFar = abs(middle) > 1.75 * reach
    for z in low.z..<high.z {
      for y in low.y..<high.y {
        let row = count.x * (y + count.y * (z - low.z))
        for x in low.x..<high.x {
          values[row + x] = isFar ? middle : solid.distance(point(SIMD3(x, y, z)))
        }
      }
    }
  }

  /// Two triangles for each edge of the lattice that the surface crosses, between the vertices of
  /// the four cells around it.
  func triangles(
    _ values: [Float], _ vertices: [Int32], _ positions: [SIMD3<Float>]
  ) -> [Triangle] {
    let steps = [1, count.x, count.x * count.y]
    var triangles: [Triangle] = []
    for index in vertices.indices where vertices[index] >= 0 {
      for axis in 0..<3 where (values[index] < 0) != (values[index + steps[axis]] < 0) {
        let (u, v) = (steps[(axis + 1) % 3], steps[(axis + 2) % 3])
        let cells = [index - u - v, index - v, index, index - u]
        precondition(cells.allSatisfy { vertices[$0] >= 0 }, "The solid leaves the lattice.")
        var corners = cells.map { UInt32(vertices[$0]) }
        if values[index] >= 0 { corners.reverse() }
        let p = corners.map { positions[Int($0)] }
        if (p[0] - p[2]).squaredLength <= (p[1] - p[3]).squaredLength {
          triangles.append(Triangle(corners[0], corners[1], corners[2]))
          triangles.append(Triangle(corners[0], corners[2], corners[3]))
        } else {
          triangles.append(Triangle(corners[1], corners[2], corners[3]))
          triangles.append(Triangle(corners[1], corners[3], corners[0]))
        }
      }
    }
    return triangles
  }
}
