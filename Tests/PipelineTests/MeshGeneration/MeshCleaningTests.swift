import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshCleaningTests {
  /// A tetrahedron whose faces point outward.
  private func tetrahedron(_ a: UInt32, _ b: UInt32, _ c: UInt32, _ d: UInt32) -> [Triangle] {
    [Triangle(a, c, b), Triangle(a, b, d), Triangle(b, c, d), Triangle(c, a, d)]
  }

  /// The number of faces on the left and on the right of each edge.
  private func sides(_ mesh: Mesh) -> [SIMD2<UInt32>: SIMD2<Int>] {
    var result: [SIMD2<UInt32>: SIMD2<Int>] = [:]
    for triangle in mesh.triangles {
      for edge in triangle.edges {
        let isForward = edge.x < edge.y
        result[isForward ? edge : [edge.y, edge.x], default: .zero] &+=
          isForward ? [1, 0] : [0, 1]
      }
    }
    return result
  }

  private func isClosedManifold(_ mesh: Mesh) -> Bool {
    sides(mesh).values.allSatisfy { $0 == [1, 1] }
  }

  @Test func surfacesTouchingAtAnEdgeAreSeparatedAndStayClosed() {
    let mesh = Mesh(
      positions: [[0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0]],
      triangles: tetrahedron(0, 1, 2, 3) + tetrahedron(0, 1, 4, 5))
    #expect(!isClosedManifold(mesh))
    let separated = mesh.splitIntoManifold()
    #expect(separated.triangles.count == 8)
    #expect(separated.positions.count == 8)
    #expect(isClosedManifold(separated))
    for (before, after) in zip(mesh.triangles, separated.triangles) {
      #expect(mesh.corners(of: before) == separated.corners(of: after))
    }
  }

  @Test func fansTouchingAtAVertexAreSeparated() {
    let mesh = Mesh(
      positions: [
        [0, 0, 0], [0, 0, 1], [1, 0, 0], [1, 1, 0], [-1, 0, 0], [-1, -1, 0], [-1, 0, 1],
      ],
      triangles: tetrahedron(0, 1, 2, 3) + tetrahedron(0, 4, 5, 6))
    let separated = mesh.splitIntoManifold()
    #expect(separated.positions.count == 8)
    #expect(isClosedManifold(separated))
  }

  @Test func manifoldsAreUnchanged() {
    let sphere = SyntheticMesh.sphere(subdivisions: 2)
    let same = sphere.splitIntoManifold()
    #expect(same.triangles == sphere.triangles)
    #expect(same.positions == sphere.positions)
  }

  @Test func degenerateEdgesLeaveNoHole() throws {
    // A closed strip around two poles, each a fan; the upper pole is duplicated, and two degenerate
    // faces join both copies.
    let ring = (0..<6).map { index -> SIMD3<Float> in
      let angle = Float(index) * .pi / 3
      return [cos(angle), sin(angle), 0]
    }
    var mesh = Mesh(positions: ring + [[0, 0, 1], [0, 0, 1], [0, 0, -1]])
    for index in UInt32(0)..<6 {
      let next = (index + 1) % 6
      mesh.triangles.append(Triangle(index, next, index < 3 ? 6 : 7))
      mesh.triangles.append(Triangle(next, index, 8))
    }
    mesh.triangles += [Triangle(6, 3, 7), Triangle(0, 6, 7)]
    #expect(isClosedManifold(mesh))
    let clean = try MeshCleaning().run(mesh, samples: PointCloud(), StageContext())
    #expect(isClosedManifold(clean))
    #expect(clean.positions.count == 8)
    #expect(clean.triangles.count == mesh.triangles.count - 2)
  }
}
