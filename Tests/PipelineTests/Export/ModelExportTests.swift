import Foundation
import Formats
import ImageFiles
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

  @Test func otherExtensionsGiveAFolder() throws {
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

  @Test func aGLBFileIsWritten() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("model.glb")
    try ModelExport().run(model(), to: url, StageContext())
    let bytes = [UInt8](try Data(contentsOf: url))
    #expect(bytes.starts(with: Array("glTF".utf8)))
    let length = bytes[8..<12].reversed().reduce(0) { $0 << 8 | Int($1) }
    #expect(length == bytes.count)
    #expect(Data(bytes).range(of: Data("\"TEXCOORD_0\"".utf8)) != nil)
    #expect(try FileManager.default.contentsOfDirectory(atPath: folder.url.path).count == 1)
  }

  @Test func roughnessIsPackedWithOcclusion() throws {
    var model = model()
    var occlusion = RasterImage(width: 64, height: 64, channels: 1, filledWith: 200)
    occlusion.pixels[65] = 7
    model.atlases[0].maps[.ambientOcclusion] = occlusion
    var export = ModelExport(options: .init(textureFormat: .jpeg(quality: 0.9)))
    var material = try #require(try export.materials(of: model, StageContext()).first)
    #expect(material.baseColor?.fileExtension == "jpg")
    #expect(material.normal?.fileExtension == "png")
    guard case .occlusion(let gray) = material.surface else { Issue.record("no occlusion"); return }
    #expect(gray.fileExtension == "jpg")

    var roughness = RasterImage(width: 64, height: 64, channels: 1, filledWith: 230)
    roughness.pixels[66] = 9
    model.atlases[0].maps[.roughness] = roughness
    material = try #require(try export.materials(of: model, StageContext()).first)
    guard case .occlusionAndRoughness(let image) = material.surface else {
      Issue.record("not packed")
      return
    }
    #expect(image.fileExtension == "png")
    let packed = try ImageCodec.decode(image.bytes)
    #expect(Array(packed.pixels[192..<204]) == [200, 230, 0, 7, 230, 0, 200, 9, 0, 200, 230, 0])

    model.atlases[0].maps[.ambientOcclusion] = nil
    export.options.textureFormat = .png
    material = try #require(try export.materials(of: model, StageContext()).first)
    guard case .roughness(let alone) = material.surface else { Issue.record("packed"); return }
    #expect(try ImageCodec.decode(alone.bytes).pixels.prefix(3) == [255, 230, 0])
  }

  @Test func aPLYFileHasNormalsAndColors() throws {
    let folder = try TemporaryFolder()
    let url = folder.url.appendingPathComponent("model.ply")
    let model = model()
    try ModelExport().run(model, to: url, StageContext())
    let read = try PLY.readMesh(url)
    #expect(read.positions == model.mesh.positions)
    #expect(read.normals == model.mesh.normals)
    #expect(read.triangles == model.mesh.triangles)
    #expect(read.colors == (try VertexColoring().run(model, StageContext()).colors))
    #expect(read.colors.count == read.positions.count)
  }

  /// Names with special meaning to file systems, URLs or shells.
  @Test(arguments: ["a b", "ü 模型", "%41#?&", "...", "-x", "it's \"it\"", "a\nb", "~", "*"])
  func unusualFileNamesAreKept(_ name: String) throws {
    let folder = try TemporaryFolder()
    let suffixes = ModelFormat.allCases.map { $0 == .folder ? "" : ".\($0.rawValue)" }
    for suffix in suffixes {
      let url = URL(
        fileURLWithPath: folder.url.path + "/" + name + suffix, isDirectory: suffix.isEmpty)
      try ModelExport().run(model(), to: url, StageContext())
    }
    #expect(
      try FileManager.default.contentsOfDirectory(atPath: folder.url.path).sorted()
        == suffixes.map { name + $0 }.sorted())
  }

  @Test(arguments: ["usdz", "glb"])
  func exportIsDeterministic(_ suffix: String) throws {
    let folder = try TemporaryFolder()
    let contents = try (1...2).map { threads in
      let url = folder.url.appendingPathComponent("\(threads).\(suffix)")
      try ModelExport().run(
        model(), to: url, StageContext(control: KernelControl(threadCount: threads)))
      return try Data(contentsOf: url)
    }
    #expect(contents[0] == contents[1])
  }

  /// A file above the limit has its color as JPEG, and its other maps as before.
  @Test func largeUSDZFilesHaveCompactColor() throws {
    let folder = try TemporaryFolder()
    func contents(maximum: Int?) throws -> Data {
      var export = ModelExport()
      export.options.maximumBytes = maximum
      let url = folder.url.appendingPathComponent("model.usdz")
      try export.run(model(), to: url, StageContext())
      return try Data(contentsOf: url)
    }
    let plain = try contents(maximum: nil)
    #expect(try contents(maximum: plain.count) == plain)
    let compact = try contents(maximum: plain.count - 1)
    #expect(compact.count < plain.count)
    for name in ["baked_mesh_tex0.jpg", "baked_mesh_norm0.png", "baked_mesh_ao0.png"] {
      #expect(compact.range(of: Data(name.utf8)) != nil)
    }
  }

  @Test func compressedExportIsDeterministic() throws {
    let folder = try TemporaryFolder()
    var options = ModelExport.Options()
    options.glbCompression = GLBCompression()
    let contents = try (1...2).map { threads in
      let url = folder.url.appendingPathComponent("\(threads).glb")
      try ModelExport(options: options).run(
        model(), to: url, StageContext(control: KernelControl(threadCount: threads)))
      return try Data(contentsOf: url)
    }
    #expect(contents[0] == contents[1])
    for name in ["EXT_meshopt_compression", "KHR_mesh_quantization", "EXT_texture_webp"] {
      #expect(contents[0].range(of: Data(name.utf8)) != nil)
    }
  }

  @Test func compressionConcernsGLBFilesOnly() throws {
    let folder = try TemporaryFolder()
    let contents = try [nil, GLBCompression()].enumerated().map { index, compression in
      var options = ModelExport.Options()
      options.glbCompression = compression
      let url = folder.url.appendingPathComponent("\(index).usdz")
      try ModelExport(options: options).run(model(), to: url, StageContext())
      return try Data(contentsOf: url)
    }
    #expect(contents[0] == contents[1])
  }

  @Test func compressedTexturesAreCloseToTheMaps() throws {
    let model = model()
    var export = ModelExport()
    export.options.glbCompression = GLBCompression()
    let material = try #require(try export.materials(of: model, StageContext()).first)
    let color = try #require(material.baseColor)
    #expect(color.fileExtension == "webp")
    let map = try #require(model.atlases[0].maps[.diffuseColor])
    let decoded = try ImageCodec.decode(color.bytes)
    let squares = zip(map.pixels, decoded.pixels).reduce(0.0) { sum, pair in
      sum + pow(Double(pair.0) - Double(pair.1), 2)
    }
    #expect(10 * log10(255 * 255 * Double(map.pixels.count) / squares) > 30)
    let normal = try #require(material.normal)
    // A plain map stays plain.
    #expect(Set(try ImageCodec.decode(normal.bytes).pixels).allSatisfy { abs(Int($0) - 128) <= 1 })
  }

  @Test func mapsThatAreTooLargeForWebPStayPNG() throws {
    var model = model()
    model.atlases[0].maps = [
      .diffuseColor: RasterImage(width: 16384, height: 2, channels: 3, filledWith: 90)
    ]
    var export = ModelExport()
    export.options.glbCompression = GLBCompression()
    let material = try #require(try export.materials(of: model, StageContext()).first)
    #expect(material.baseColor?.fileExtension == "png")
  }

  @Test func failedExportLeavesNoFiles() throws {
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
