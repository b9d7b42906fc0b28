import Foundation
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct QuadPairingTests {
  /// A mesh whose texture has no seam except the one that `seam` adds.
  private func textured(
    _ mesh: Mesh, seam: (SIMD3<Float>) -> Bool = { _ in false }
  ) -> TexturedMesh {
    // The triangles on the far side of the seam have separate coordinates.
    let count = UInt32(mesh.positions.count)
    let texture = mesh.triangles.map { t in
      let (a, b, c) = mesh.corners(of: t)
      let offset = seam((a + b + c) / 3) ? count : 0
      return Triangle(t.a + offset, t.b + offset, t.c + offset)
    }
    let coordinates = mesh.positions.map { SIMD2($0.x, $0.y) }
    return TexturedMesh(
      mesh: mesh, textureCoordinates: coordinates + coordinates, textureTriangles: texture,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: [:])])
  }

  private func paired(_ model: TexturedMesh) throws -> TexturedMesh {
    try QuadPairing().run(model, StageContext())
  }

  /// The corners of the quads, in the mesh and in the texture.
  private func quads(_ model: TexturedMesh) throws -> [(corners: [UInt32], texels: [UInt32])] {
    try model.atlases.flatMap { atlas in
      try stride(from: atlas.halves.lowerBound, to: atlas.halves.upperBound, by: 2).map { half in
        let (t, u) = (model.mesh.triangles[half], model.mesh.triangles[half + 1])
        let (s, r) = (model.textureTriangles[half], model.textureTriangles[half + 1])
        try #require(t.a == u.a && t.c == u.b && s.a == r.a && s.c == r.b)
        return (t.quad(with: u), s.quad(with: r))
      }
    }
  }

  /// Triangles independent of their first corner.
  private func set(_ triangles: [Triangle]) -> Set<Triangle> {
    Set(
      triangles.map { t in
        let least = min(t.a, t.b, t.c)
        return least == t.a
          ? t : least == t.b ? Triangle(t.b, t.c, t.a) : Triangle(t.c, t.a, t.b)
      })
  }

  private let grid = SyntheticMesh.grid(
    cells: 8, origin: [0, 0, 0], u: [1, 0, 0], v: [0, 1, 0])

  @Test func aGridBecomesSquares() throws {
    let model = try paired(textured(grid))
    let all = try quads(model)
    #expect(all.count == 64 && model.mesh.triangles.count == 128)
    for quad in all {
      let p = quad.corners.map { model.mesh.positions[Int($0)] }
      for corner in 0..<4 {
        #expect(abs((p[(corner + 1) % 4] - p[corner]).length - 0.125) < 1e-6)
      }
      #expect(quad.corners == quad.texels)
    }
  }

  @Test func noQuadCrossesASeam() throws {
    // Through the diagonal of each square.
    let model = try paired(
      textured(grid) { p in
        p.x.truncatingRemainder(dividingBy: 0.125)
          < p.y
          .truncatingRemainder(dividingBy: 0.125)
      })
    let all = try quads(model)
    #expect(set(model.mesh.triangles) == set(grid.triangles))
    for quad in all {
      #expect(Set(quad.texels.map { $0 < UInt32(grid.positions.count) }).count == 1)
    }
    #expect(try paired(textured(grid) { $0.x < 0.5 }).atlases[0].quadCount == 64)
  }

  @Test func mostOfARoundSurfaceIsPaired() throws {
    let sphere = textured(SyntheticMesh.sphere(subdivisions: 4))
    let model = try paired(sphere)
    let count = model.atlases[0].quadCount
    #expect(Double(2 * count) > 0.9 * Double(model.mesh.triangles.count))
    #expect(set(model.mesh.triangles) == set(sphere.mesh.triangles))
    #expect(set(model.textureTriangles) == set(sphere.textureTriangles))
    #expect(try paired(sphere).mesh.triangles == model.mesh.triangles)
    let positions = model.mesh.positions
    for quad in try quads(model) {
      let p = quad.corners.map { positions[Int($0)] }
      let middle = p.reduce(.zero, +)
      for corner in 0..<4 {
        let (next, last) = (p[(corner + 1) % 4] - p[corner], p[(corner + 3) % 4] - p[corner])
        #expect(next.cross(last).dot(middle) > 0)
      }
    }
  }

  @Test func noQuadBendsAroundAnEdge() throws {
    let model = try paired(textured(SyntheticMesh.cube(cells: 3)))
    #expect(try quads(model).count == 54)
    for quad in try quads(model) {
      let p = quad.corners.map { model.mesh.positions[Int($0)] }
      #expect((0..<3).contains { axis in Set(p.map { $0[axis] }).count == 1 })
    }
  }

  @Test func texturesKeepTheirTriangles() throws {
    var model = textured(SyntheticMesh.sphere(subdivisions: 3))
    let half = model.mesh.triangles.count / 2
    model.atlases = [0..<half, half..<2 * half].map { TextureAtlas(triangles: $0, maps: [:]) }
    let result = try paired(model)
    for atlas in result.atlases {
      #expect(
        set(Array(result.mesh.triangles[atlas.triangles]))
          == set(Array(model.mesh.triangles[atlas.triangles])))
      #expect(atlas.quadCount > half / 3)
    }
  }

  @Test func mirroredQuadsStayQuads() throws {
    let mirror = AffineMap(x: [-1, 0, 0], y: [0, 1, 0], z: [0, 0, 1])
    let model = try paired(textured(SyntheticMesh.sphere(subdivisions: 3)))
    let mirrored = model.transformed(by: mirror)
    let (before, after) = (try quads(model), try quads(mirrored))
    #expect(before.count == after.count && before.count > 200)
    for (one, other) in zip(before, after) {
      #expect(Set(one.corners) == Set(other.corners) && one.corners != other.corners)
    }
  }
}
