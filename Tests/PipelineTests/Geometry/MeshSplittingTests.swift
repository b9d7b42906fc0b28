import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshSplittingTests {
  private func heights(_ mesh: Mesh, above z: Float) -> [Float] { mesh.positions.map { $0.z - z } }

  private func volume(_ mesh: Mesh) -> Float {
    mesh.triangles.reduce(0) { sum, triangle in
      let (a, b, c) = mesh.corners(of: triangle)
      return sum + a.dot(b.cross(c)) / 6
    }
  }

  @Test(arguments: [Float](arrayLiteral: -0.7, 0, 0.123, 0.5, 0.999))
  func noTriangleCrossesTheLine(z: Float) {
    let split = SyntheticMesh.sphere(subdivisions: 4)
    let mesh = split.split(where: heights(split, above: z))
    for triangle in mesh.triangles {
      let heights = triangle.vertices.map { mesh.positions[$0].z - z }
      #expect(heights.allSatisfy { $0 > -1e-6 } || heights.allSatisfy { $0 < 1e-6 })
    }
  }

  @Test func closedSurfacesStayClosed() {
    let sphere = SyntheticMesh.sphere(subdivisions: 4)
    let mesh = sphere.split(where: heights(sphere, above: 0.123))
    #expect(mesh.triangles.count > sphere.triangles.count)
    #expect(MeshTopology(mesh).edges.allSatisfy { $0.second >= 0 })
    #expect(abs(volume(mesh) - volume(sphere)) < 1e-3)
  }

  @Test func thereAreNoSlivers() {
    let sphere = SyntheticMesh.sphere(subdivisions: 4)
    let smallest = sphere.triangleAreas().min() ?? 0
    let mesh = sphere.split(where: heights(sphere, above: 0.123))
    // Snapping leaves no part of an edge below 0.15; of two edges, about its square.
    #expect((mesh.triangleAreas().min() ?? 0) > 0.01 * smallest)
  }

  @Test func meshesOnOneSideAreUnchanged() {
    let sphere = SyntheticMesh.sphere(subdivisions: 2)
    let mesh = sphere.split(where: heights(sphere, above: -2))
    #expect(mesh.positions == sphere.positions && mesh.triangles == sphere.triangles)
  }
}
