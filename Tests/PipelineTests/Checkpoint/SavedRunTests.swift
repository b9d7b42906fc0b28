import Formats
import Foundation
import ImageFiles
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// A finished run: photos of a ball, exact cameras and an exact surface in a checkpoint directory.
private struct FinishedRun {
  let temporary: TemporaryFolder
  let reconstruction: Reconstruction
  let ingested: IngestedPhotos
  let surface: Mesh

  var folder: URL { temporary.url }
  var photos: URL { folder.appendingPathComponent("photos", isDirectory: true) }
  var checkpoint: URL { folder.appendingPathComponent("work", isDirectory: true) }

  /// `mask` is the mask of the first photo.
  init(mask: RasterImage? = nil) throws {
    temporary = try TemporaryFolder()
    let scene = SphereScene(viewCount: 9, imageSize: 320) { p in
      let stripes = sin(17 * p.x) + sin(23 * p.y + 5 * p.z)
      return SIMD3(130 + 40 * stripes, 120 + 60 * sin(31 * p.z), 140)
    }
    try temporary.writePhotos(scene.images)
    if let mask { try temporary.write(ImageCodec.encodePNG(mask), as: "photos/masks/p0.png") }
    ingested = try PhotoIngestion().run(
      folder: temporary.url.appendingPathComponent("photos"), StageContext())
    var reconstruction = scene.reconstruction
    try #require(ingested.photos.count == reconstruction.photos.count)
    reconstruction.photos = ingested.photos
    for index in reconstruction.photos.indices { reconstruction.photos[index].camera = ID(0) }
    // One photo has no pose.
    reconstruction.poses[4] = nil
    self.reconstruction = reconstruction
    surface = SyntheticMesh.sphere(subdivisions: 5)
    try write()
  }

  private func write() throws {
    let content = Checkpoint(directory: checkpoint)
    try FileManager.default.createDirectory(at: checkpoint, withIntermediateDirectories: true)
    try content.write(reconstruction)
    try content.write(surface)
    try content.write(
      SurfaceRecord(
        reconstruction, of: ingested, in: photos, viewPixels: 80_000,
        sparseHash: try #require(content.sparseHash)))
  }

  func file(_ name: String) -> URL { checkpoint.appendingPathComponent(name) }

  /// Modifies a file of the checkpoint.
  func change(_ name: String, _ body: (inout Data) throws -> Void) throws {
    var data = try Data(contentsOf: file(name))
    try body(&data)
    try data.write(to: file(name))
  }

  /// Replaces text in a file of the checkpoint.
  func replace(_ text: String, by other: String, in name: String) throws {
    try change(name) { data in
      let content = String(decoding: data, as: UTF8.self)
      try #require(content.contains(text))
      data = Data(content.replacingOccurrences(of: text, with: other).utf8)
    }
  }

  func remove(_ url: URL) throws { try FileManager.default.removeItem(at: url) }

  func saved(photos: URL? = nil) throws -> SavedRun {
    try SavedRun(checkpoint: checkpoint, photos: photos)
  }

  /// The error thrown on reading.
  func fault() -> SavedRunError? {
    do {
      _ = try saved()
      return nil
    } catch {
      return error as? SavedRunError
    }
  }
}

@Suite(.endToEnd) struct SavedRunTests {
  private let small = DetailSpecification(
    maximumTriangles: 3000, textureSide: 512, maps: Set(TextureMap.allCases), viewPixels: 80_000)

  private func written(
    _ pipeline: ReconstructionPipeline, _ specification: DetailSpecification, _ url: URL
  ) throws -> Data {
    try pipeline.writeModel(specification, to: url)
    return try Data(contentsOf: url)
  }

  @Test func masksOfTheRunAreUsed() throws {
    var mask = RasterImage(width: 320, height: 320, channels: 1)
    mask.pixels.replaceSubrange(0..<6400, with: [UInt8](repeating: 255, count: 6400))
    let run = try FinishedRun(mask: mask)
    let used = try #require(run.ingested.photos[0].mask)
    let moved = run.folder.appendingPathComponent("moved", isDirectory: true)
    try FileManager.default.copyItem(at: run.photos, to: moved)
    // Masks that were added later are ignored.
    try run.temporary.write(ImageCodec.encodePNG(mask), as: "photos/masks/p1.png")
    for folder in [run.photos, moved] {
      let photos = try SavedPhotos().run(run.saved(photos: folder), StageContext()).photos
      #expect(photos.map { $0.mask != nil } == [true] + [Bool](repeating: false, count: 7))
      #expect(photos[0].mask?.orientation == used.orientation)
      #expect(
        photos[0].mask?.file?.standardizedFileURL.path
          == folder.appendingPathComponent("masks/p0.png").standardizedFileURL.path)
      #expect(try ImageStore(photos: photos).mask(ID(0)) == mask)
    }
    mask.pixels[0] = 0
    try run.temporary.write(ImageCodec.encodePNG(mask), as: "photos/masks/p0.png")
    #expect(throws: SavedRunError.changedPhotos(folder: run.photos.path, names: ["p0.png"])) {
      try SavedPhotos().run(run.saved(photos: run.photos), StageContext())
    }
  }

  @Test func exportReproducesTheModelOfTheRun() throws {
    let run = try FinishedRun()
    let images = ImageStore(
      photos: run.ingested.photos, processingPixels: run.ingested.processingPixels)
    let simplified = try Simplification(options: .init(maximumTriangles: small.maximumTriangles))
      .run(run.surface, StageContext())
    let model = try TextureMapping(
      options: .init(textureSide: small.textureSide, maps: small.maps)
    ).run(
      simplified, dense: run.surface, reconstruction: run.reconstruction, images: images,
      StageContext())
    let (first, second) = (
      run.folder.appendingPathComponent("a.usdz"), run.folder.appendingPathComponent("b.usdz")
    )
    try ModelExport().run(model, to: first, StageContext())

    let before = try FileManager.default.subpathsOfDirectory(atPath: run.checkpoint.path).sorted()
    let pipeline = ReconstructionPipeline(
      .savedRun(try run.saved()), configuration: PipelineConfiguration())
    #expect(try written(pipeline, small, second) == Data(contentsOf: first))
    let after = try FileManager.default.subpathsOfDirectory(atPath: run.checkpoint.path).sorted()
    #expect(before == after)
    #expect(pipeline.report.warnings.isEmpty)
    #expect(pipeline.report.photos.count { $0.status == .registered } == 8)
  }

  @Test func finerLevelsKeepTheirBudgetAndWarn() throws {
    let run = try FinishedRun()
    let warnings = Locked<[String]>([])
    let pipeline = ReconstructionPipeline(
      .savedRun(try run.saved()), configuration: PipelineConfiguration()
    ) { event in
      if case .warning(let sentence) = event { warnings.withLock { $0.append(sentence) } }
    }
    var finer = small
    (finer.maximumTriangles, finer.textureSide, finer.viewPixels) = (5000, 1024, 2_000_000)
    let models = try [small, finer].map { try pipeline.model(for: $0) }
    #expect((2000...3000).contains(models[0].mesh.triangles.count))
    #expect((4000...5000).contains(models[1].mesh.triangles.count))
    for (model, side) in zip(models, [512, 1024]) {
      #expect(model.atlases.allSatisfy { $0.maps.values.allSatisfy { $0.width <= side } })
    }
    let recorded = warnings.withLock { $0 }
    #expect(recorded.count == 1)
    for pixels in ["0.08 MP", "2.0 MP"] { #expect(recorded.first?.contains(pixels) == true) }
    #expect(pipeline.report.warnings == recorded)
  }

  @Test func photosMayMove() throws {
    let run = try FinishedRun()
    let original = try ReconstructionPipeline(
      .savedRun(try run.saved()), configuration: PipelineConfiguration()
    ).model(for: small)
    let moved = run.folder.appendingPathComponent("moved", isDirectory: true)
    try FileManager.default.moveItem(at: run.photos, to: moved)
    #expect(run.fault() == .noPhotos(folder: run.photos.standardizedFileURL.path))
    let pipeline = ReconstructionPipeline(
      .savedRun(try run.saved(photos: moved)), configuration: PipelineConfiguration())
    let model = try pipeline.model(for: small)
    #expect(model.mesh.triangles == original.mesh.triangles && !model.mesh.triangles.isEmpty)
    #expect(model.mesh.positions == original.mesh.positions)
    #expect(model.atlases.map(\.maps) == original.atlases.map(\.maps))
  }

  @Test func missingFilesAreReported() throws {
    let run = try FinishedRun()
    let path = run.checkpoint.path
    try run.remove(run.photos.appendingPathComponent("p3.jpg"))
    // This photo had no pose.
    try run.remove(run.photos.appendingPathComponent("p4.jpg"))
    let photos = run.photos.standardizedFileURL.path
    #expect(run.fault() == .missingPhotos(folder: photos, names: ["p3.jpg"]))
    try run.remove(run.file("mesh/surface.json"))
    #expect(run.fault() == .noRecord(path: run.file("mesh/surface.json").path))
    try run.remove(run.file("mesh/surface.ply"))
    #expect(run.fault() == .unfinished(directory: path))
    try run.remove(run.file("sparse/images.txt"))
    #expect(run.fault() == .noCheckpoint(directory: path))
    try run.remove(run.checkpoint)
    #expect(run.fault() == .noDirectory(path: path))
  }

  @Test func changedPhotosAreReported() throws {
    let run = try FinishedRun()
    let other = try ImageCodec.encodeJPEG(
      TexturePattern.image(width: 320, height: 320, seed: 3), quality: 0.9)
    try run.temporary.write(other, as: "photos/p2.jpg")
    try run.temporary.write("no photo", as: "photos/p7.jpg")
    let pipeline = ReconstructionPipeline(
      .savedRun(try run.saved()), configuration: PipelineConfiguration())
    let output = run.folder.appendingPathComponent("m.usdz")
    #expect(
      throws: SavedRunError.changedPhotos(
        folder: run.photos.standardizedFileURL.path, names: ["p2.jpg", "p7.jpg"])
    ) { try pipeline.writeModel(small, to: output) }
    #expect(!FileManager.default.fileExists(atPath: output.path))
    #expect(pipeline.report.errors.count == 1)
  }

  @Test func recordsOfOtherVersionsAreRefused() throws {
    let run = try FinishedRun()
    let path = run.file("mesh/surface.json").path
    try run.replace(#""format" : 1"#, by: #""format" : 2"#, in: "mesh/surface.json")
    #expect(run.fault() == .otherVersion(path: path, format: 2))
    for text in ["{\"format\": 1}", "{}", "[", ""] {
      try run.change("mesh/surface.json") { $0 = Data(text.utf8) }
      guard case .damaged(path, _) = run.fault() else {
        Issue.record("\(text) was accepted")
        continue
      }
    }
  }

  @Test func camerasOfAnotherRunAreRefused() throws {
    let run = try FinishedRun()
    try run.change("sparse/cameras.txt") { $0 += Data("# another\n".utf8) }
    #expect(run.fault() == .mixed(directory: run.checkpoint.path))
  }

  @Test func damagedSurfacesAreRefused() throws {
    let run = try FinishedRun()
    let file = run.file("mesh/surface.ply")
    let whole = try Data(contentsOf: file)
    var noNumber = run.surface
    noNumber.normals[7].y = .nan
    var elsewhere = run.surface
    elsewhere.triangles[3].b = 1_000_000
    let faults: [Data] = [
      Data(), whole.prefix(20), whole.prefix(whole.count / 2), whole.dropLast(3),
      Data(PLY.encode(Mesh(positions: run.surface.positions))), Data(PLY.encode(noNumber)),
      Data(PLY.encode(elsewhere)),
    ]
    var reasons: Set<String> = []
    for (index, data) in faults.enumerated() {
      try data.write(to: file)
      guard case .damaged(file.path, let reason) = run.fault() else {
        Issue.record("fault \(index) was accepted")
        continue
      }
      reasons.insert(reason)
    }
    // Of the header, the size, the triangles, the normal and the index.
    #expect(reasons.count >= 5 && !reasons.contains(""))
  }

  @Test func everyErrorHasASentenceAndARemedy() {
    let errors: [SavedRunError] = [
      .noDirectory(path: "a"), .noCheckpoint(directory: "a"), .unfinished(directory: "a"),
      .noRecord(path: "a"), .otherVersion(path: "a", format: 9), .mixed(directory: "a"),
      .damaged(path: "a", reason: "b"), .noPhotos(folder: "a"),
      .missingPhotos(folder: "a", names: (0..<9).map(String.init)),
      .changedPhotos(folder: "a", names: ["b"]),
    ]
    for error in errors {
      #expect(error.errorDescription?.hasSuffix(".") == true)
      #expect(error.recoverySuggestion?.contains("--") == true)
    }
    #expect(errors[8].errorDescription?.contains("and 4 more") == true)
  }
}
