import Foundation
import Formats
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct ModelExportTests {
  private func model() -> TexturedMesh {
    let mesh = SyntheticMesh.sphere(subdivisions: 1)
    let uvs = mesh.positions.map { SIMD2<Float>(0.5 + $0.x / 2, 0.5 + $0.y / 2) }
    let maps: [TextureMap: RasterImage] = [
      .diffuseColor: TexturePattern.image(width: 64, height: 64, seed: 1),
      .normal: RasterImage(width: 64, height: 64, channels: 3, filledWith: 128),
      .ambientOcclusion: RasterImage(width: 64, height: 64, channels: 1, filledWith: 200),
    ]
    return TexturedMesh(
      mesh: mesh, textureCoordinates: uvs, textureTriangles: mesh.triangles,
      atlases: [TextureAtlas(triangles: 0..<mesh.triangles.count, maps: maps)])
  }

  @Test func aUSDZFileIsWritten() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("model.USDZ")
    try ModelExport().run(model(), to: url, StageContext())
    let bytes = [UInt8](try Data(contentsOf: url))
    #expect(bytes.starts(with: [0x50, 0x4B]))
    for name in ["baked_mesh_tex0.png", "baked_mesh_norm0.png", "baked_mesh_ao0.png"] {
      #expect(Data(bytes).range(of: Data(name.utf8)) != nil)
    }
    #expect(try FileManager.default.contentsOfDirectory(atPath: folder.url.path).count == 1)
  }

  @Test func otherNamesGiveAFolder() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("model", isDirectory: true)
    try ModelExport(options: .init(textureFormat: .jpeg(quality: 0.8)))
      .run(model(), to: url, StageContext())
    let names = Set(try FileManager.default.contentsOfDirectory(atPath: url.path))
    #expect(
      names.isSuperset(of: [
        "baked_mesh.obj", "baked_mesh.mtl", "baked_mesh.usda", "baked_mesh_tex0.jpg",
        "baked_mesh_norm0.png", "baked_mesh_ao0.jpg",
      ]))
  }

  @Test func theSameModelGivesTheSameBytes() throws {
    let folder = try TemporaryFolder()
    let contents = try (1...2).map { threads in
      let url = folder.url.appendingPathComponent("\(threads).usdz")
      try ModelExport().run(
        model(), to: url, StageContext(control: KernelControl(threadCount: threads)))
      return try Data(contentsOf: url)
    }
    #expect(contents[0] == contents[1])
  }

  @Test func whatCannotBeWrittenLeavesNothing() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("missing/model.usdz")
    #expect(throws: OutputError.self) { try ModelExport().run(model(), to: url, StageContext()) }
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try ModelExport().run(
        model(), to: folder.url.appendingPathComponent("model.usdz"),
        StageContext(control: KernelControl(flag: flag)))
    }
    #expect(try FileManager.default.contentsOfDirectory(atPath: folder.url.path).isEmpty)
  }
}
