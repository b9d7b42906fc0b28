import SceneModel
import Testing

@testable import Pipeline

@Suite struct VertexColoringTests {
  /// A triangle in an atlas whose red increases to the right and whose green increases downward.
  private func model() -> TexturedMesh {
    var image = RasterImage(width: 16, height: 16, channels: 3)
    for y in 0..<16 {
      for x in 0..<16 {
        image.pixels[3 * (16 * y + x)] = UInt8(10 * x)
        image.pixels[3 * (16 * y + x) + 1] = UInt8(10 * y)
      }
    }
    let mesh = Mesh(
      positions: [[0, 0, 0], [1, 0, 0], [0, 1, 0]], normals: [], triangles: [Triangle(0, 1, 2)])
    return TexturedMesh(
      mesh: mesh,
      // The center of a texel, the midpoint between four, the bottom right corner.
      textureCoordinates: [[2.5 / 16, 1 - 4.5 / 16], [8.0 / 16, 1 - 12.0 / 16], [1, 0]],
      textureTriangles: [Triangle(0, 1, 2)],
      atlases: [TextureAtlas(triangles: 0..<1, maps: [.diffuseColor: image])])
  }

  private func colors(_ model: TexturedMesh) throws -> [SIMD3<UInt8>] {
    try VertexColoring().run(model, StageContext()).colors
  }

  @Test func colorsAreInterpolatedBetweenTexels() throws {
    #expect(try colors(model()) == [[20, 40, 0], [75, 115, 0], [150, 150, 0]])
  }

  @Test func chartsThatMeetAreAveraged() throws {
    var model = model()
    // Another triangle at the same edge, elsewhere in the texture, and one more with the first's.
    model.mesh.positions.append([1, 1, 0])
    model.mesh.triangles += [Triangle(1, 0, 3), Triangle(0, 2, 3)]
    model.textureCoordinates += [[10.5 / 16, 1 - 0.5 / 16], [0, 1]]
    model.textureTriangles += [Triangle(1, 3, 4), Triangle(0, 2, 4)]
    model.atlases[0].triangles = 0..<3
    #expect(try colors(model) == [[60, 20, 0], [75, 115, 0], [150, 150, 0], [0, 0, 0]])
  }

  @Test func everyAtlasHasItsOwnImage() throws {
    var model = model()
    model.mesh.positions += [[2, 0, 0], [3, 0, 0], [2, 1, 0]]
    model.mesh.triangles.append(Triangle(3, 4, 5))
    model.textureTriangles.append(Triangle(0, 1, 2))
    let gray = RasterImage(width: 4, height: 4, channels: 1, filledWith: 33)
    model.atlases.append(TextureAtlas(triangles: 1..<2, maps: [.diffuseColor: gray]))
    let last = try colors(model).suffix(3)
    #expect(Array(last) == [[33, 33, 33], [33, 33, 33], [33, 33, 33]])
  }

  @Test func meshColorsAreKept() throws {
    var model = model()
    model.mesh.colors = [[1, 2, 3], [4, 5, 6], [7, 8, 9]]
    #expect(try colors(model) == model.mesh.colors)
  }

  @Test func withoutAColorMapThereAreNoColors() throws {
    var model = model()
    model.atlases[0].maps = [:]
    #expect(try colors(model).isEmpty)
  }
}
