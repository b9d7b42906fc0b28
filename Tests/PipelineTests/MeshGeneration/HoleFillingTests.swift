import SceneModel
import Testing

@testable import Pipeline

@Suite struct HoleFillingTests {
  /// A square of 40 × 40 cells with a dome at its center, within `radius`.
  func dome(radius: Float) -> (mesh: Mesh, isDome: [Bool]) {
    var mesh = Mesh()
    for y in 0...40 {
      for x in 0...40 {
        let (u, v) = (Float(x) - 20, Float(y) - 20)
        mesh.positions.append([u, max(0, radius * radius - u * u - v * v).squareRoot(), v])
      }
    }
    for y in UInt32(0)..<40 {
      for x in UInt32(0)..<40 {
        let i = 41 * y + x
        mesh.triangles += [Triangle(i, i + 41, i + 1), Triangle(i + 1, i + 41, i + 42)]
      }
    }
    let isDome = mesh.triangles.map { $0.vertices.contains { mesh.positions[$0].y > 0 } }
    return (mesh, isDome)
  }

  @Test func largeHoleIsFilledFlat() {
    let (mesh, isDome) = dome(radius: 10)
    let closed = HoleFilling().run(mesh, isRemoved: isDome) { _ in false }
    #expect(closed.triangles == mesh.triangles)
    #expect(closed.positions.allSatisfy { abs($0.y) < 1e-3 })
    // The graph is that of a grid: its harmonic map is the identity.
    for (position, before) in zip(closed.positions, mesh.positions) {
      #expect(abs(position.x - before.x) < 0.02 && abs(position.z - before.z) < 0.02)
    }
  }

  @Test func smallHoleKeepsItsShape() {
    let (mesh, isDome) = dome(radius: 10)
    var holeFilling = HoleFilling()
    holeFilling.options.smallShare = 0.9
    let closed = holeFilling.run(mesh, isRemoved: isDome) { _ in false }
    #expect(closed.positions == mesh.positions)
    #expect(closed.triangles == mesh.triangles)
  }

  @Test func holeInFreeSpaceStaysOpen() {
    let (mesh, isDome) = dome(radius: 10)
    let open = HoleFilling().run(mesh, isRemoved: isDome) { $0.x > 0 }
    #expect(open.triangles.count == isDome.count { !$0 })
    // What occludes the dome doesn't occlude the membrane.
    let closed = HoleFilling().run(mesh, isRemoved: isDome) { $0.y > 1 }
    #expect(closed.triangles == mesh.triangles)
  }

  @Test func contactWithTheSupportIsFilled() {
    let (mesh, isDome) = dome(radius: 15)
    let open = HoleFilling().run(mesh, isRemoved: isDome) { $0.x > 0 }
    #expect(open.triangles.count == isDome.count { !$0 })
    let support = SupportPlane(normal: [0, 1, 0], offset: -0.1, band: 0.1)
    let closed = HoleFilling().run(mesh, isRemoved: isDome, support: support) { $0.x > 0 }
    #expect(closed.triangles == mesh.triangles)
    #expect(closed.positions[41 * 20 + 20].y == -0.1)
    // Between the support and the boundary it slopes.
    let slope = (20...35).map { closed.positions[41 * 20 + $0].y }
    #expect(zip(slope, slope.dropFirst()).allSatisfy { $0 <= $1 && $1 - $0 < 0.05 })
    #expect(slope.last == 0)
  }

  @Test func bulgeOverAFewFacesIsRemoved() {
    let (mesh, _) = dome(radius: 10)
    // Of a plane with a dome, only the outermost cells are kept.
    let isRemoved = mesh.triangles.map { triangle in
      triangle.vertices.allSatisfy {
        max(abs(mesh.positions[$0].x), abs(mesh.positions[$0].z)) < 18.5
      }
    }
    var holeFilling = HoleFilling()
    holeFilling.options.fillsLarge = false
    holeFilling.options.smallShare = 0.95
    let kept = isRemoved.count { !$0 }
    #expect(holeFilling.run(mesh, isRemoved: isRemoved) { _ in false }.triangles.count == kept)
    // As part of an object's surface it stays.
    holeFilling.options.fillsLarge = true
    holeFilling.options.smallShare = 0.05
    let closed = holeFilling.run(mesh, isRemoved: isRemoved) { _ in false }
    #expect(closed.triangles == mesh.triangles)
  }

  @Test func largeHoleOfASceneStaysOpen() {
    let (mesh, isDome) = dome(radius: 10)
    var holeFilling = HoleFilling()
    holeFilling.options.fillsLarge = false
    let open = holeFilling.run(mesh, isRemoved: isDome) { _ in false }
    #expect(open.triangles.count == isDome.count { !$0 })
  }

  @Test func componentWithoutBoundaryIsRemoved() {
    let (mesh, isDome) = dome(radius: 10)
    #expect(
      HoleFilling().run(mesh, isRemoved: isDome.map { _ in true }) { _ in false }.triangles.isEmpty)
  }

  @Test func holeAtAnOpenBoundaryIsCapped() {
    // The removed part is an open plate around the dome: only a cap can close it.
    let (mesh, isDome) = dome(radius: 10)
    let closed = HoleFilling().run(mesh, isRemoved: isDome.map { !$0 }) { _ in false }
    #expect(closed.triangles.count == mesh.triangles.count + 4 * 40)
    var directed = Set<SIMD2<UInt32>>()
    for t in closed.triangles {
      for edge in [SIMD2(t.a, t.b), SIMD2(t.b, t.c), SIMD2(t.c, t.a)] {
        #expect(directed.insert(edge).inserted)
      }
    }
    #expect(directed.allSatisfy { directed.contains([$0.y, $0.x]) })
    // The membrane spans the boundary of the dome.
    let boundary = zip(mesh.positions, closed.positions).filter { $0 != $1 }.map(\.1)
    #expect(boundary.count > 1000)
    #expect(boundary.allSatisfy { abs($0.x) < 12 && abs($0.z) < 12 && abs($0.y) < 6 })
  }

  @Test func holesTouchingAtAVertexAreSeparate() {
    let (mesh, _) = dome(radius: 0)
    let isRemoved = mesh.triangles.map { triangle in
      let (a, b, c) = mesh.corners(of: triangle)
      let p = (a + b + c) / 3
      return abs(p.x) < 8 && abs(p.z) < 8 && p.x * p.z > 0
    }
    let closed = HoleFilling().run(mesh, isRemoved: isRemoved) { $0.x > 0 }
    #expect(closed.triangles.count == mesh.triangles.count - isRemoved.count { $0 } / 2)
  }
}
