import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct BoundarySmoothingTests {
  /// A square of `side`² cells in the plane y = 0, two faces each.
  func square(_ side: UInt32) -> Mesh {
    var mesh = Mesh()
    for z in 0...side {
      for x in 0...side { mesh.positions.append([Float(x), 0, Float(z)]) }
    }
    for z in 0..<side {
      for x in 0..<side {
        let i = (side + 1) * z + x
        mesh.triangles += [
          Triangle(i, i + side + 1, i + 1), Triangle(i + 1, i + side + 1, i + side + 2),
        ]
      }
    }
    return mesh
  }

  /// The length of the boundary between kept and removed faces, in edges.
  func boundaryLength(_ mesh: Mesh, _ isRemoved: [Bool]) -> Int {
    var sides: [SIMD2<UInt32>: Set<Bool>] = [:]
    for (triangle, isRemoved) in zip(mesh.triangles, isRemoved) {
      for edge in triangle.edges {
        sides[[min(edge.x, edge.y), max(edge.x, edge.y)], default: []].insert(isRemoved)
      }
    }
    return sides.values.count { $0.count == 2 }
  }

  /// Kept where x is less than the middle, plus a different spike or notch in each row.
  func ragged(_ mesh: Mesh, side: Float) -> [Bool] {
    var random = SeededGenerator(seed: 6)
    let ends = (0..<Int(side)).map { _ in side / 2 + Float.random(in: -4...4, using: &random) }
    return mesh.triangles.map { mesh.center(of: $0).x > ends[Int(mesh.center(of: $0).z)] }
  }

  @Test func raggedBoundaryBecomesStraight() {
    let mesh = square(60)
    let isRemoved = ragged(mesh, side: 60)
    let smooth = BoundarySmoothing().run(mesh, isRemoved: isRemoved) { _ in true }
    #expect(boundaryLength(mesh, isRemoved) > 200)
    #expect(boundaryLength(mesh, smooth) < 110)
    for (triangle, isRemoved) in zip(mesh.triangles, smooth) {
      let x = mesh.center(of: triangle).x
      #expect(isRemoved == (x > 30) || abs(x - 30) < 3)
    }
  }

  /// A surface that ends raggedly just before the line x = 30, beyond which there is nothing.
  @Test func surfaceIsContinuedToWhereItMustEnd() {
    let mesh = square(60)
    let xs = mesh.triangles.map { mesh.center(of: $0).x }
    var random = SeededGenerator(seed: 7)
    let ends = (0..<60).map { _ in Float.random(in: 26...31, using: &random) }
    let isRemoved = mesh.triangles.indices.map { face in
      xs[face] > ends[Int(mesh.center(of: mesh.triangles[face]).z)] || xs[face] > 30
    }
    let smooth = BoundarySmoothing().run(
      mesh, isRemoved: isRemoved, isOutside: xs.map { $0 > 30 }
    ) { _ in true }
    #expect(smooth == xs.map { $0 > 30 })
  }

  @Test func straightBoundaryIsUnchanged() {
    let mesh = square(60)
    let isRemoved = mesh.triangles.map { mesh.center(of: $0).x > 30 }
    let smooth = BoundarySmoothing().run(mesh, isRemoved: isRemoved) { _ in true }
    for (index, triangle) in mesh.triangles.enumerated() where smooth[index] != isRemoved[index] {
      // At the border of the plane, vertices have faces on one side only.
      let center = mesh.center(of: triangle)
      #expect(abs(center.x - 30) < (center.z < 2 || center.z > 58 ? 2 : 1))
    }
  }

  @Test func nonRestorableFacesStayRemoved() {
    let mesh = square(60)
    let isRemoved = ragged(mesh, side: 60)
    let smooth = BoundarySmoothing().run(mesh, isRemoved: isRemoved) { _ in false }
    #expect(zip(isRemoved, smooth).allSatisfy { !$0 || $1 })
    #expect(smooth != isRemoved)
  }

  @Test func straightBoundaryOfARodIsUnchanged() {
    var mesh = Mesh()
    for ring in 0...40 {
      for corner in [SIMD2<Float>(1, 0), [0, 1], [-1, 0], [0, -1]] {
        mesh.positions.append([corner.x, Float(ring), corner.y])
      }
    }
    for ring in UInt32(0)..<40 {
      for corner in UInt32(0)..<4 {
        let (a, b) = (4 * ring + corner, 4 * ring + (corner + 1) % 4)
        mesh.triangles += [Triangle(a, a + 4, b), Triangle(b, a + 4, b + 4)]
      }
    }
    // Its lower quarter is removed.
    let isRemoved = mesh.triangles.map { mesh.center(of: $0).y < 10 }
    let smooth = BoundarySmoothing().run(mesh, isRemoved: isRemoved) { _ in true }
    for (triangle, isRemoved) in zip(mesh.triangles, smooth) {
      let y = mesh.center(of: triangle).y
      #expect(isRemoved == (y < 10) || abs(y - 10) < 2)
    }
  }
}
