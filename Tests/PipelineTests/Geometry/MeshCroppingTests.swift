import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshCroppingTests {
  private func area(_ mesh: Mesh) -> Float { mesh.triangleAreas().reduce(0, +) }

  /// Edges with a triangle on one side only.
  private func border(_ mesh: Mesh) -> [(SIMD3<Float>, SIMD3<Float>)] {
    MeshTopology(mesh).edges.filter { $0.second < 0 }
      .map { (mesh.positions[Int($0.low)], mesh.positions[Int($0.high)]) }
  }

  @Test func aCubeIsCutInHalf() throws {
    // Faces of the box lie between the vertices.
    let cube = SyntheticMesh.cube(cells: 5)
    let box = OrientedBox(min: [-2, -2, -2], max: [0.1, 2, 2])
    let parts = MeshCropping(box: box).run(cube)
    let bounds = try #require(parts.inside.bounds)
    #expect((bounds.min - [-1, -1, -1]).length < 1e-6 && (bounds.max - [0.1, 1, 1]).length < 1e-6)
    #expect(abs(area(parts.inside) - (4 + 4 * 2 * 1.1)) < 1e-4)
    // Open only at the cut, where triangles share the vertices.
    let open = border(parts.inside)
    #expect(open.allSatisfy { abs($0.x - 0.1) < 1e-6 && abs($1.x - 0.1) < 1e-6 })
    #expect(abs(open.map { ($0 - $1).length }.reduce(0, +) - 8) < 1e-4)
    let outside = try #require(parts.outside.bounds)
    #expect(outside.min.x > 0.1 && outside.max.x == 1 && area(parts.outside) < 4 + 4 * 2 * 0.9)
  }

  @Test func aRotatedBoxClipsAtItsFaces() throws {
    let sphere = SyntheticMesh.sphere(subdivisions: 5)
    let turn = Quaternion(angle: .pi / 4, axis: [0, 0, 1])
    let box = OrientedBox(center: [0.2, 0, 0], halfExtents: [0.5, 0.7, 3], rotation: turn)
    let inside = MeshCropping(box: box).run(sphere).inside
    let local = inside.positions.map {
      SIMD3<Float>(turn.conjugate * SIMD3<Double>($0 - box.center))
    }
    let reach = local.reduce(SIMD3<Float>.zero) { pointwiseMax($0, pointwiseMax($1, -$1)) }
    #expect(abs(reach.x - 0.5) < 1e-4 && abs(reach.y - 0.7) < 1e-4 && reach.z <= 1)
    #expect(inside.normals.count == inside.positions.count)
    for (p, n) in zip(inside.positions, inside.normals) {
      #expect((p.normalized - n).length < 0.01 && abs(n.length - 1) < 1e-5)
    }
  }

  @Test func colorsAreInterpolatedAtTheCut() {
    var mesh = SyntheticMesh.grid(cells: 1, origin: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0])
    mesh.colors = mesh.positions.map { [UInt8(200 * $0.x), 10, 0] }
    let box = OrientedBox(min: [-1, -1, -1], max: [0.25, 2, 1])
    let inside = MeshCropping(box: box).run(mesh).inside
    for (p, c) in zip(inside.positions, inside.colors) {
      #expect(abs(Float(c.x) - 200 * p.x) <= 0.5 && c.y == 10)
    }
    #expect(abs(area(inside) - 0.25) < 1e-6)
    #expect(inside.triangles.allSatisfy { $0.vertices.max() ?? 9 < inside.positions.count })
  }

  @Test func meshesEntirelyInsideOrOutsideAreNotClipped() {
    let sphere = SyntheticMesh.sphere(subdivisions: 2)
    let all = MeshCropping(box: OrientedBox(min: [-1, -1, -1], max: [1, 1, 1])).run(sphere)
    #expect(all.inside.triangles == sphere.triangles && all.inside.positions == sphere.positions)
    #expect(all.outside.triangles.isEmpty)
    let none = MeshCropping(box: OrientedBox(min: [2, 2, 2], max: [3, 3, 3])).run(sphere)
    #expect(none.inside.triangles.isEmpty && none.inside.positions.isEmpty)
    #expect(none.outside.triangles.count == sphere.triangles.count)
  }

  @Test func verticesOnABoxFaceCreateNoSlivers() {
    // The box ends at vertices of the cube's grid.
    let cube = SyntheticMesh.cube(cells: 4)
    let inside = MeshCropping(box: OrientedBox(min: [-2, -2, -2], max: [0.5, 0.5, 2])).run(cube)
      .inside
    #expect(inside.triangleAreas().allSatisfy { abs($0 - 0.125) < 1e-6 })
    #expect(abs(area(inside) - (2 * 1.5 * 1.5 + 2 * 2 * 1.5)) < 1e-4)
  }
}

@Suite struct AffineMapTests {
  private func sphere() -> TexturedMesh {
    let mesh = SyntheticMesh.sphere(subdivisions: 3)
    return TexturedMesh(
      mesh: mesh, textureCoordinates: mesh.positions.map { [$0.x, $0.y] },
      textureTriangles: mesh.triangles, atlases: [])
  }

  @Test(arguments: [
    AffineMap(x: [2, 0, 0], y: [0, 1, 0], z: [0, 0, 0.5], translation: [1, 2, 3]),
    AffineMap(x: [-1, 0, 0], y: [0, 3, 0], z: [0, 0, 1]),
    AffineMap(x: [0, 0, -1], y: [0, 1, 0], z: [2, 0, 0]),
  ])
  func normalsStayPerpendicular(_ transform: AffineMap) {
    let (before, after) = (sphere(), sphere().transformed(by: transform))
    let factor = Double(abs(transform.x.dot(transform.y.cross(transform.z))))
    #expect(abs(after.mesh.volume / before.mesh.volume - factor) < 1e-3)
    let expected = Mesh(positions: after.mesh.positions, triangles: after.mesh.triangles)
      .angleWeightedNormals()
    for (n, e) in zip(after.mesh.normals, expected) { #expect(n.dot(e) > 0.98) }
    // Corners keep their texture coordinates.
    for (t, uv) in zip(after.mesh.triangles, after.textureTriangles) { #expect(t == uv) }
  }

  @Test func identityTransformIsExact() {
    let before = sphere()
    let after = before.transformed(by: .identity)
    #expect(after.mesh.positions == before.mesh.positions)
    #expect(after.mesh.normals == before.mesh.normals)
  }
}
