import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

/// Files as other programs write them.
@Suite struct OBJFileTests {
  private func read(
    _ object: String, materials: String? = nil, images: [String] = []
  ) throws -> LoadedModel {
    let folder = try TemporaryFolder()
    if let materials { try folder.write(materials, as: "my materials.mtl") }
    for (index, image) in images.enumerated() {
      try folder.write(Sample.image(index).bytes, as: image)
    }
    return try ModelFile.read(try folder.write(object, as: "model.obj"))
  }

  @Test func materialsTexturesAndPolygons() throws {
    let model = try read(
      """
      # A comment
      mtllib my materials.mtl
      v 0 0 0 1.0
      v 1 0 0
      v 1 1 0
      v 0 1e0 0
      vt 0 0
      vt 1 0
      vt 1 1
      vn 0 0 1
      usemtl first one
      f 1/1/1 2/2/1 3/3/1 \\
        -1/-2/-1
      g group
      usemtl second
      f 1 3 4
      usemtl first one
      f 4/1/1 1/2/1 2/3/1
      l 1 2
      """,
      materials: """
        newmtl first one
        Kd 0.1 0.2 0.3
        map_Kd -s 1 1 1 -clamp on the color map.png
        newmtl second
        Kd 1 0.5 0
        """, images: ["the color map.png"])
    try #require(model.parts.count == 2)
    let (first, second) = (model.parts[0], model.parts[1])
    #expect(first.triangles == [Triangle(0, 1, 2), Triangle(0, 2, 3), Triangle(4, 5, 6)])
    #expect(first.textureCoordinates[3] == [1, 0] && first.normals[3] == [0, 0, 1])
    #expect(first.positions[3] == [0, 1, 0] && first.colors.isEmpty)
    #expect(first.baseColor == Sample.image(0) && first.baseColorFactor == [1, 1, 1])
    #expect(second.positions == [[0, 0, 0], [1, 1, 0], [0, 1, 0]])
    #expect(second.baseColor == nil && second.textureCoordinates.isEmpty)
    #expect(LinearColor(second.baseColorFactor).bytes == [255, 128, 0])
    #expect(model.missingFiles == [])
  }

  @Test func vertexColorsAndWindowsLineEnds() throws {
    let model = try read(
      "v 0 0 0 1 0 0.5\r\nv 1 0 0 0 1 0\r\nv 0 1 0 0 0 2\r\nf 1// 2// 3//\r\n")
    #expect(model.parts[0].colors == [[255, 0, 128], [0, 255, 0], [0, 0, 255]])
  }

  @Test func missingFilesAreListed() throws {
    let triangle =
      "mtllib none.mtl\nmtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3"
    let model = try read(triangle, materials: "newmtl a\nmap_Kd C:\\work\\none.png")
    #expect(model.missingFiles == ["none.mtl", "C:\\work\\none.png"])
    let found = try read(
      triangle, materials: "newmtl a\nmap_Kd C:\\work\\a.png", images: ["a.png"])
    #expect(found.parts[0].baseColor == Sample.image(0))
  }

  @Test(arguments: [
    "f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1 2 99999999999", "v 0 0\nf 1 2 3", "v 1 nan 2\nf 1 2 4",
    "f 1 2", "v 1e999 0 0\nf 1 2 4",
  ])
  func invalidFacesAreRefused(lines: String) throws {
    #expect(throws: FormatError.self) { try read("v 0 0 0\nv 1 0 0\nv 0 1 0\n\(lines)") }
  }

  /// All corners at one vertex, each with its own texture coordinate.
  @Test func manyCornersAtAVertexTakeLinearTime() throws {
    let count = 60_000
    var text = "v 0 0 0\n"
    for index in 0..<count { text += "vt \(index) 0\n" }
    for index in stride(from: 1, to: count - 1, by: 3) {
      text += "f 1/\(index) 1/\(index + 1) 1/\(index + 2)\n"
    }
    let start = ContinuousClock.now
    #expect(try read(text).parts[0].positions.count == count)
    #expect(ContinuousClock.now - start < .seconds(10))
  }
}
