import Foundation
import SceneModel
import Testing

@testable import Formats

@Suite struct GLBTests {
  private func image(_ text: String, _ fileExtension: String = "png") -> EncodedImage {
    EncodedImage(fileExtension: fileExtension, bytes: Array(text.utf8))
  }

  /// A square of two triangles that share an edge; at one of its ends their texture coordinates
  /// differ.
  private var square: TexturedMesh {
    let mesh = Mesh(
      positions: [[9, 9, 9], [0, 0, 0.1], [1, 0, 0.1], [1, 1, -3], [0, 1, 0.1]],
      normals: [[0, 1, 0], [0, 0, 1], [0, 0, 1], [1, 0, 0], [0, 0, 2]],
      triangles: [Triangle(1, 2, 3), Triangle(1, 3, 4)])
    return TexturedMesh(
      mesh: mesh, textureCoordinates: [[0, 0], [0.25, 0], [0.25, 0.75], [0.5, 1], [0, 1]],
      textureTriangles: [Triangle(0, 1, 2), Triangle(0, 3, 4)],
      atlases: [TextureAtlas(triangles: 0..<2, maps: [:])])
  }

  /// The expected corners of `range` in a file.
  private func corners(_ mesh: TexturedMesh, _ range: Range<Int>) -> [GLBReader.Corner] {
    range.flatMap { face in
      let (t, st) = (mesh.mesh.triangles[face], mesh.textureTriangles[face])
      return [(t.a, st.a), (t.b, st.b), (t.c, st.c)].map { vertex, coordinate in
        let coordinate = mesh.textureCoordinates[Int(coordinate)]
        return GLBReader.Corner(
          position: mesh.mesh.positions[Int(vertex)],
          normal: mesh.mesh.normals[Int(vertex)].normalized,
          textureCoordinate: [coordinate.x, 1 - coordinate.y])
      }
    }
  }

  @Test func verticesAreSplitOnlyWhereTextureCoordinatesDiffer() throws {
    let file = try GLBReader(
      try GLBFile.encode(
        square, materials: [GLTFMaterial(baseColor: image("color"))], creator: "tests"))
    let primitive = try #require(file.primitives.first)
    #expect(try file.positions(of: primitive).count == 5)
    #expect(try file.corners(of: primitive) == corners(square, 0..<2))
    let accessor = try #require(
      file.list("accessors").first { $0["min"] != nil } as GLBReader.Object?)
    let (low, high) = (accessor["min"] as? [Double], accessor["max"] as? [Double])
    // No triangle uses the first vertex, so it must not count.
    #expect(low?.map { Float($0) } == [0, 0, -3])
    #expect(high?.map { Float($0) } == [1, 1, 0.1])
  }

  @Test(arguments: [1, 3])
  func geometryRoundTrips(_ atlasCount: Int) throws {
    let sphere = Sample.sphere(rings: 7, atlasCount: atlasCount)
    let file = try GLBReader(try GLBFile.encode(sphere, materials: [], creator: "tests"))
    #expect(file.primitives.count == atlasCount)
    for (atlas, primitive) in zip(sphere.atlases, file.primitives) {
      #expect(try file.corners(of: primitive) == corners(sphere, atlas.triangles))
      let used = Set(try file.indices(of: primitive))
      #expect(used == Set(0..<(try file.positions(of: primitive).count)))
      let pairs = Set(
        atlas.triangles.flatMap { face -> [SIMD2<UInt32>] in
          let (t, st) = (sphere.mesh.triangles[face], sphere.textureTriangles[face])
          return [[t.a, st.a], [t.b, st.b], [t.c, st.c]]
        })
      #expect(used.count == pairs.count)
    }
    #expect(file.list("scenes").first?["nodes"] as? [Int] == [0])
    #expect(file.list("nodes").first?["mesh"] as? Int == 0)
    #expect((file.root["asset"] as? GLBReader.Object)?["version"] as? String == "2.0")
    #expect((file.root["asset"] as? GLBReader.Object)?["generator"] as? String == "tests")
  }

  @Test func materialsReferenceTheirImages() throws {
    let sphere = Sample.sphere(rings: 3, atlasCount: 2)
    let materials = [
      GLTFMaterial(
        baseColor: image("color", "jpg"), normal: image("normals"),
        surface: .occlusion(image("occlusion"))),
      GLTFMaterial(surface: .occlusionAndRoughness(image("packed"))),
    ]
    let file = try GLBReader(
      try GLBFile.encode(sphere, materials: materials, creator: "tests"))
    #expect(file.primitives.map { $0["material"] as? Int } == [0, 1])
    #expect(file.list("images").count == 4)
    let color = try file.image(0, "pbrMetallicRoughness", "baseColorTexture")
    #expect(color?.mediaType == "image/jpeg")
    #expect(color?.bytes == Array("color".utf8))
    #expect(try file.image(0, "normalTexture")?.bytes == Array("normals".utf8))
    #expect(try file.image(0, "occlusionTexture")?.bytes == Array("occlusion".utf8))
    #expect(try file.image(0, "pbrMetallicRoughness", "metallicRoughnessTexture") == nil)
    #expect(try file.image(1, "occlusionTexture")?.mediaType == "image/png")
    #expect(try file.image(1, "occlusionTexture")?.bytes == Array("packed".utf8))
    #expect(
      try file.image(1, "pbrMetallicRoughness", "metallicRoughnessTexture")?.bytes
        == Array("packed".utf8))
    let factors = file.list("materials").map { $0["pbrMetallicRoughness"] as? GLBReader.Object }
    #expect(factors.map { $0?["metallicFactor"] as? Double } == [0, 0])
    #expect(factors.map { $0?["roughnessFactor"] as? Double } == [0.9, 1])
  }

  @Test func roughnessAloneAddsNoOcclusion() throws {
    let material = GLTFMaterial(surface: .roughness(image("rough")))
    let file = try GLBReader(
      try GLBFile.encode(square, materials: [material], creator: "tests"))
    #expect(try file.image(0, "occlusionTexture") == nil)
    #expect(
      try file.image(0, "pbrMetallicRoughness", "metallicRoughnessTexture")?.bytes
        == Array("rough".utf8))
  }

  @Test func missingAttributesAreOmitted() throws {
    var mesh = square
    mesh.mesh.normals = []
    (mesh.textureCoordinates, mesh.textureTriangles) = ([], [])
    let file = try GLBReader(
      try GLBFile.encode(
        mesh, materials: [GLTFMaterial(baseColor: image("color"))], creator: "tests"))
    let primitive = try #require(file.primitives.first)
    #expect(primitive["attributes"] as? [String: Int] == ["POSITION": 0])
    #expect(try file.positions(of: primitive).count == 4)
    // An image is unusable without texture coordinates.
    #expect(file.root["images"] == nil && file.root["textures"] == nil)
  }

  @Test func normalsHaveUnitLength() throws {
    var mesh = square
    mesh.mesh.normals[1] = .zero
    let file = try GLBReader(try GLBFile.encode(mesh, materials: [], creator: "tests"))
    for corner in try file.corners(of: try #require(file.primitives.first)) {
      #expect(abs((corner.normal ?? .zero).length - 1) < 1e-6)
    }
  }

  @Test func anEmptyMeshIsAnEmptyScene() throws {
    let empty = TexturedMesh(
      mesh: Mesh(), textureCoordinates: [], textureTriangles: [], atlases: [])
    let file = try GLBReader(try GLBFile.encode(empty, materials: [], creator: "tests"))
    #expect(file.root.keys.sorted() == ["asset", "scene", "scenes"])
    #expect(file.binary.isEmpty)
  }

  @Test func theSameModelGivesTheSameBytes() throws {
    let sphere = Sample.sphere(rings: 10, atlasCount: 2)
    let materials = [GLTFMaterial(baseColor: image("color"), normal: image("normals"))]
    let bytes = try (0..<2).map { _ in
      try GLBFile.encode(sphere, materials: materials, creator: "tests")
    }
    #expect(bytes[0] == bytes[1])
  }

  @Test func fileExtensionSelectsTheFormat() {
    let names = [
      "model.usdz": ModelFormat.usdz, "MODEL.GLB": .glb, "a.b.ply": .ply, "model": .folder,
      "model.obj": .folder, ".glb": .folder, "model.glb.bak": .folder,
    ]
    for (name, format) in names {
      #expect(ModelFormat(of: URL(fileURLWithPath: "/x/" + name)) == format, "\(name)")
    }
  }
}
