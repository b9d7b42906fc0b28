import SceneModel
import Testing

@Suite struct MeshTests {
  @Test func boundsAreTheExtremes() throws {
    #expect(Mesh().bounds == nil)
    let bounds = try #require(Mesh(positions: [[1, -2, 3], [-1, 5, 3], [0, 0, 9]]).bounds)
    #expect(bounds.min == [-1, -2, 3] && bounds.max == [1, 5, 9])
  }

  @Test func trianglesFlipAndPair() {
    let triangle = Triangle(1, 2, 3)
    #expect(triangle.flipped == Triangle(1, 3, 2) && triangle.flipped.flipped == triangle)
    #expect(triangle.quad(with: Triangle(1, 3, 4)) == [1, 2, 3, 4])
  }

  @Test func mapsSortInTheOrderOfTheirCases() {
    #expect(
      [TextureMap.ambientOcclusion, .normal, .displacement, .diffuseColor, .roughness].sorted()
        == [.diffuseColor, .normal, .roughness, .displacement, .ambientOcclusion])
  }

  @Test func halvesAreTheFirstTriangles() {
    var atlas = TextureAtlas(triangles: 10..<20, maps: [:])
    #expect(atlas.halves == 10..<10)
    atlas.quadCount = 3
    #expect(atlas.halves == 10..<16)
  }
}

@Suite struct TransformedMeshTests {
  /// A quad of two triangles and a further triangle in the plane z = 0, seen from +z.
  private let model: TexturedMesh = {
    let mesh = Mesh(
      positions: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0]],
      normals: [SIMD3<Float>](repeating: [0, 0, 1], count: 5),
      triangles: [Triangle(0, 1, 2), Triangle(0, 2, 3), Triangle(1, 4, 2)])
    var atlas = TextureAtlas(triangles: 0..<3, maps: [:])
    atlas.quadCount = 1
    return TexturedMesh(
      mesh: mesh, textureCoordinates: [[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]],
      textureTriangles: mesh.triangles, atlases: [atlas])
  }()

  private func area(_ model: TexturedMesh, _ triangle: Triangle) -> SIMD3<Float> {
    let positions = [triangle.a, triangle.b, triangle.c].map { model.mesh.positions[Int($0)] }
    return (positions[1] - positions[0]).cross(positions[2] - positions[0])
  }

  @Test func rotationsTurnPositionsAndNormals() {
    // x → y → z → x.
    let turned = model.transformed(
      by: AffineMap(x: [0, 1, 0], y: [0, 0, 1], z: [1, 0, 0], translation: [5, 6, 7]))
    #expect(turned.mesh.positions[1] == [5, 7, 7] && turned.mesh.positions[3] == [5, 6, 8])
    #expect(turned.mesh.normals == [SIMD3<Float>](repeating: [1, 0, 0], count: 5))
    #expect(turned.mesh.triangles == model.mesh.triangles)
    #expect(turned.textureCoordinates == model.textureCoordinates)
  }

  @Test(arguments: [
    AffineMap(x: [-1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]),
    AffineMap(x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, -2]),
    AffineMap(x: [0, 1, 0], y: [1, 0, 0], z: [0, 0, 1], translation: [1, 2, 3]),
    AffineMap(x: [2, 0, 0], y: [1, 3, 0], z: [0, 0.5, 1]),
  ]) func trianglesFaceTheirNormals(map: AffineMap) {
    let result = model.transformed(by: map)
    for triangle in result.mesh.triangles {
      let normal = result.mesh.normals[Int(triangle.a)]
      #expect(area(result, triangle).dot(normal) > 0)
    }
    #expect(result.textureTriangles == result.mesh.triangles)
  }

  @Test func mirroredQuadsKeepTheirSharedDiagonal() {
    let mirrored = model.transformed(by: AffineMap(x: [-1, 0, 0], y: [0, 1, 0], z: [0, 0, 1]))
    let (first, second) = (mirrored.mesh.triangles[0], mirrored.mesh.triangles[1])
    // The halves are (a, b, c) and (a, c, d).
    #expect(first.a == second.a && first.c == second.b)
    #expect(Set(first.quad(with: second)) == [0, 1, 2, 3])
  }

  @Test func theIdentityChangesNothing() {
    let same = model.transformed(by: .identity)
    #expect(same.mesh.positions == model.mesh.positions && same.mesh.normals == model.mesh.normals)
    #expect(same.mesh.triangles == model.mesh.triangles)
  }
}

@Suite struct IndexedTrianglesTests {
  private func mesh(_ coordinates: [Triangle]) -> TexturedMesh {
    TexturedMesh(
      mesh: Mesh(
        positions: [SIMD3<Float>](repeating: .zero, count: 4),
        triangles: [Triangle(3, 1, 2), Triangle(3, 2, 0)]),
      textureCoordinates: [SIMD2<Float>](repeating: .zero, count: 6),
      textureTriangles: coordinates, atlases: [])
  }

  @Test func verticesWithoutTextureAreShared() {
    let indexed = IndexedTriangles(mesh([]), triangles: 0..<2)
    #expect(indexed.positions == [3, 1, 2, 0] && indexed.coordinates.isEmpty)
    #expect(indexed.indices == [0, 1, 2, 0, 2, 3])
  }

  @Test func verticesAreSplitOnlyWhereCoordinatesDiffer() {
    // Position 3 has the coordinates 0 and 4, position 2 has 2 in both triangles.
    let indexed = IndexedTriangles(
      mesh([Triangle(0, 1, 2), Triangle(4, 2, 3)]), triangles: 0..<2)
    #expect(indexed.positions == [3, 1, 2, 3, 0] && indexed.coordinates == [0, 1, 2, 4, 3])
    #expect(indexed.indices == [0, 1, 2, 3, 2, 4])
  }

  @Test func onlyTrianglesOfTheRangeCount() {
    let indexed = IndexedTriangles(
      mesh([Triangle(0, 1, 2), Triangle(4, 2, 3)]), triangles: 1..<2)
    #expect(indexed.positions == [3, 2, 0] && indexed.indices == [0, 1, 2])
    #expect(IndexedTriangles(mesh([]), triangles: 0..<0).positions.isEmpty)
  }

  /// Every corner keeps its position and its texture coordinate.
  @Test func randomMeshesKeepEveryCorner() {
    var random = SplitMix64(seed: 30)
    func triangles(_ limit: Int) -> [Triangle] {
      (0..<200).map { _ in
        let corners = random.distinct(3, below: limit).map { UInt32($0) }
        return Triangle(corners[0], corners[1], corners[2])
      }
    }
    let (positions, coordinates) = (triangles(40), triangles(25))
    let mesh = TexturedMesh(
      mesh: Mesh(
        positions: [SIMD3<Float>](repeating: .zero, count: 40), triangles: positions),
      textureCoordinates: [SIMD2<Float>](repeating: .zero, count: 25),
      textureTriangles: coordinates, atlases: [])
    let indexed = IndexedTriangles(mesh, triangles: 50..<150)
    func corners(_ triangles: [Triangle]) -> [UInt32] {
      triangles[50..<150].flatMap { [$0.a, $0.b, $0.c] }
    }
    #expect(indexed.indices.map { indexed.positions[Int($0)] } == corners(positions))
    #expect(indexed.indices.map { indexed.coordinates[Int($0)] } == corners(coordinates))
    let vertices = zip(indexed.positions, indexed.coordinates).map { SIMD2($0, $1) }
    #expect(Set(vertices).count == vertices.count)
  }
}
