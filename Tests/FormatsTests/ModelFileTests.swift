import Foundation
import SceneModel
import TestFiles
import Testing

@testable import Formats

/// What the writers of this module write is read again.
@Suite struct ModelFileTests {
  /// A triangle corner with its attributes.
  private struct Corner {
    var position: SIMD3<Float>
    var normal: SIMD3<Float>
    var coordinate: SIMD2<Float>
  }

  private static func corners(of model: ModelContent, atlas: Int) -> [Corner] {
    let mesh = model.mesh
    return mesh.atlases[atlas].triangles.flatMap { index in
      let (t, st) = (mesh.mesh.triangles[index], mesh.textureTriangles[index])
      return [(t.a, st.a), (t.b, st.b), (t.c, st.c)].map {
        Corner(
          position: mesh.mesh.positions[Int($0)], normal: mesh.mesh.normals[Int($0)],
          coordinate: mesh.textureCoordinates[Int($1)])
      }
    }
  }

  private static func corners(of part: LoadedModel.Part) -> [Corner] {
    part.triangles.flatMap { [$0.a, $0.b, $0.c] }.map {
      Corner(
        position: part.positions[Int($0)], normal: part.normals[Int($0)],
        coordinate: part.textureCoordinates[Int($0)])
    }
  }

  /// Expects the parts of `model` in the same order, with tolerances.
  private func expect(
    _ loaded: LoadedModel, toEqual model: ModelContent, position: Float = 0, normal: Float = 1e-6,
    coordinate: Float = 1e-6
  ) throws {
    #expect(loaded.missingFiles == [])
    try #require(loaded.parts.count == model.mesh.atlases.count)
    for (index, part) in loaded.parts.enumerated() {
      #expect(part.baseColor == Sample.image(index))
      #expect(part.baseColorFactor == [1, 1, 1] && part.colors.isEmpty)
      let (found, expected) = (Self.corners(of: part), Self.corners(of: model, atlas: index))
      try #require(found.count == expected.count)
      let largest = zip(found, expected).reduce(SIMD3<Float>.zero) { result, pair in
        pointwiseMax(
          result,
          [
            (pair.0.position - pair.1.position).length, (pair.0.normal - pair.1.normal).length,
            (pair.0.coordinate - pair.1.coordinate).length,
          ])
      }
      #expect(largest.x <= position && largest.y <= normal && largest.z <= coordinate)
      // A vertex per position and texture coordinate, not per corner.
      #expect(part.positions.count < found.count / 3)
    }
  }

  @Test(arguments: [1, 3]) func packages(atlasCount: Int) throws {
    let model = Sample.colored(rings: 9, atlasCount: atlasCount)
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("model.USDZ")
      try USDZPackage.write(model, to: url)
      try expect(try ModelFile.read(url), toEqual: model)
    }
  }

  @Test(arguments: [1, 3]) func foldersAndTheirFiles(atlasCount: Int) throws {
    let model = Sample.colored(rings: 9, atlasCount: atlasCount)
    try withTemporaryFolder { folder in
      let url = folder.appendingPathComponent("model with spaces")
      try OBJFolder.write(model, to: url)
      try expect(try ModelFile.read(url), toEqual: model)
      for name in ["baked_mesh.obj", "baked_mesh.usda"] {
        try expect(try ModelFile.read(url.appendingPathComponent(name)), toEqual: model)
      }
    }
  }

  @Test func layersAsFilesOfTheirOwn() throws {
    let model = Sample.colored(rings: 9, atlasCount: 2)
    let folder = try TemporaryFolder()
    let layer = USDModelLayer().layer(model)
    for index in 0..<2 {
      try folder.write(Sample.image(index).bytes, as: "0/baked_mesh_tex\(index).png")
    }
    for bytes in [USDCrate.encode(layer), Array(USDAText.encode(layer).utf8)] {
      try expect(
        try ModelFile.read(try folder.write(bytes, as: "model.usd")), toEqual: model)
    }
  }

  @Test(arguments: [1, 3]) func binaryGLTF(atlasCount: Int) throws {
    let model = Sample.colored(rings: 9, atlasCount: atlasCount)
    let materials = (0..<atlasCount).map { GLTFMaterial(baseColor: Sample.image($0)) }
    let bytes = try GLBFile.encode(model.mesh, materials: materials, creator: "tests")
    let folder = try TemporaryFolder()
    let url = try folder.write(bytes, as: "model.glb")
    try expect(try ModelFile.read(url), toEqual: model)
  }

  @Test func compressedGLTF() throws {
    let model = Sample.colored(rings: 9, atlasCount: 2)
    let materials = (0..<2).map { GLTFMaterial(baseColor: Sample.image($0)) }
    let bytes = try GLBFile.encode(
      model.mesh, materials: materials, creator: "tests", compressedBy: StoringCodec())
    let folder = try TemporaryFolder()
    let url = try folder.write(bytes, as: "model.glb")
    try expect(
      try ModelFile.read(url, decompressedBy: StoringCodec()), toEqual: model, position: 1e-4,
      normal: 0.03, coordinate: 2e-5)
    #expect(throws: FormatError.self) { try ModelFile.read(url) }
  }

  @Test func coloredMeshes() throws {
    var mesh = Sample.sphere(rings: 5).mesh
    mesh.colors = mesh.positions.indices.map { [UInt8($0), 2, 3] }
    let folder = try TemporaryFolder()
    let loaded = try ModelFile.read(try folder.write(PLY.encode(mesh), as: "model.ply"))
    #expect(loaded.parts.count == 1)
    let result = loaded.mesh
    #expect(result.positions == mesh.positions && result.triangles == mesh.triangles)
    #expect(result.normals == mesh.normals && result.colors == mesh.colors)
    #expect(loaded.parts[0].textureCoordinates.isEmpty && loaded.parts[0].baseColor == nil)
  }

  @Test func theMeshOfAllPartsIsTheSurface() throws {
    let model = Sample.colored(rings: 6, atlasCount: 3)
    let folder = try TemporaryFolder()
    let url = try folder.write(try USDZPackage.encode(model), as: "model.usdz")
    let mesh = try ModelFile.read(url).mesh
    #expect(mesh.triangles.count == model.mesh.mesh.triangles.count)
    for (found, expected) in zip(mesh.triangles, model.mesh.mesh.triangles) {
      #expect(
        mesh.positions[Int(found.a)] == model.mesh.mesh.positions[Int(expected.a)]
          && mesh.positions[Int(found.c)] == model.mesh.mesh.positions[Int(expected.c)])
    }
  }

  @Test func errorsNameTheFileAndTheRemedy() throws {
    let folder = try TemporaryFolder()
    let empty = TexturedMesh(
      mesh: Mesh(), textureCoordinates: [], textureTriangles: [], atlases: [])
    let files = [
      try folder.write(
        try USDZPackage.encode(ModelContent(mesh: empty, textures: [], creator: "")),
        as: "empty.usdz"),
      try folder.write([], as: "nothing.glb"), try folder.write([1, 2, 3], as: "short.usdc"),
      try folder.write("v 0 0\n", as: "text.obj"), try folder.write("{", as: "text.gltf"),
      try folder.write("solid", as: "other.stl"), folder.url.appendingPathComponent("no.usda"),
      folder.url,
    ]
    for url in files {
      let error = #expect(throws: FormatError.self) { try ModelFile.read(url) }
      #expect(error?.errorDescription?.hasPrefix(url.path) == true)
      #expect(error?.recoverySuggestion?.isEmpty == false)
    }
  }
}
