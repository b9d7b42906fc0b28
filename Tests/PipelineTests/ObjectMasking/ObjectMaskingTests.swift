import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

/// Masks of a statue on a table, estimated from the photos alone.
@Suite(.endToEnd, .serialized) struct ObjectMaskingTests {
  private static let reconstruction = Result {
    try ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: PipelineConfiguration()
    ).align()
  }

  private static let result = Result { try estimated(threads: 2) }

  private static func estimated(threads: Int) throws -> ObjectMasking.Result? {
    let reconstruction = try Self.reconstruction.get()
    return try ObjectMasking().run(
      reconstruction, images: ImageStore(photos: reconstruction.photos),
      StageContext(control: KernelControl(threadCount: threads)))
  }

  @Test func masksAreThoseOfTheObject() throws {
    let result = try #require(try Self.result.get())
    let photos = try Self.reconstruction.get().photos
    #expect(photos.indices.allSatisfy { photos[$0].name == RenderedScene.name($0) })
    let first = try #require(result.masks[0])
    #expect(first.channels == 1 && first.width * first.height <= 300_000)
    #expect(first.pixels.allSatisfy { $0 == 0 || $0 == 255 })
    // Rays through the pixels of the smaller images, for a third of the photos.
    let scene = RenderedScene.statue(width: first.width, height: first.height)
    let indices = Array(stride(from: 0, to: photos.count, by: 3))
    let exact = try KernelControl(threadCount: 2).parallelMap(indices.count) {
      scene.mask(indices[$0])
    }
    let scores = try zip(indices, exact).map { index, exact in
      try #require(result.masks[index]).intersectionOverUnion(with: exact)
    }
    let mean = scores.reduce(0, +) / Double(scores.count)
    #expect(mean >= 0.95, "\(scores)")
    #expect(result.masks.map { $0 == nil } == result.agreement.map { $0 == nil })
    #expect(result.support != nil && result.points.surroundings.count > 100)
  }

  @Test func threadsDoNotChangeTheMasks() throws {
    let two = try #require(try Self.result.get())
    let one = try #require(try Self.estimated(threads: 1))
    let isEqual = one.masks == two.masks
    #expect(isEqual)
    #expect(one.agreement == two.agreement)
    #expect(one.support == two.support)
    let areSurroundingsEqual =
      one.points.surroundings.positions == two.points.surroundings.positions
    #expect(areSurroundingsEqual)
  }

  /// A textured ground with nothing on it.
  @Test func withoutAnObjectThereAreNoMasks() throws {
    let ground = RenderedScene.Surface(
      mesh: SyntheticMesh.grid(cells: 60, origin: [-1, 0, 1], u: [2, 0, 0], v: [0, 0, -2]),
      texture: SolidTexture(
        palette: [[0.10, 0.06, 0.035], [0.36, 0.24, 0.13], [0.58, 0.47, 0.33]],
        wavelength: 0.09, octaves: 6, seed: 5))
    let poses = (0..<10).map { index in
      let angle = 2 * Double.pi * Double(index) / 10
      return RigidTransform.lookingAt(
        .zero, from: [0.58 * sin(angle), 0.69, 0.58 * cos(angle)])
    }
    var scene = RenderedScene(
      object: ground, surroundings: [],
      camera: Camera(width: 320, height: 240, focalLength: [368, 368]), poses: poses)
    scene.samplesPerSide = 1
    let context = StageContext(control: KernelControl(threadCount: 2))
    let (reconstruction, images) = (
      scene.reconstruction(), ImageStore(images: try scene.photos(context.control))
    )
    let masking = ObjectMasking()
    // There is a surface, but no object.
    let cloud = try PointCloudGeneration(options: masking.options.coarse)
      .coarseCloud(reconstruction, images: images, context)
    #expect(cloud.count > 100)
    #expect(try masking.run(reconstruction, images: images, context) == nil)
  }
}

/// Estimated masks in a checkpoint directory.
@Suite(.endToEnd, .serialized) struct ObjectMaskingResumeTests {
  private let folder: TemporaryFolder

  init() throws { folder = try TemporaryFolder() }

  private var checkpoint: URL { folder.url.appendingPathComponent("checkpoint") }
  private var masks: URL { checkpoint.appendingPathComponent("masks") }

  private func run(_ name: String) throws -> (model: Data, report: RunReport) {
    var configuration = PipelineConfiguration()
    configuration.checkpointDirectory = checkpoint
    configuration.maskOutput = folder.url.appendingPathComponent("written")
    let output = folder.url.appendingPathComponent(name)
    let pipeline = ReconstructionPipeline(
      .photos(in: Fixtures.images(of: "orbit")), configuration: configuration)
    try pipeline.writeModel(DetailSpecification(.preview), to: output)
    return (try Data(contentsOf: output), pipeline.report)
  }

  /// The bytes of all files of a folder.
  private func contents(of folder: URL) throws -> [String: Data] {
    let names = try FileManager.default.contentsOfDirectory(atPath: folder.path)
    return try Dictionary(
      uniqueKeysWithValues: names.map {
        ($0, try Data(contentsOf: folder.appendingPathComponent($0)))
      })
  }

  private func modificationDate(_ name: String) throws -> Date {
    let file = masks.appendingPathComponent(name)
    let attributes = try FileManager.default.attributesOfItem(atPath: file.path)
    return try #require(attributes[.modificationDate] as? Date)
  }

  @Test func masksAreReusedAndRepaired() throws {
    let first = try run("first.usdz")
    #expect(first.report.stages.map(\.name).contains("objectMasking"))
    let estimated = try contents(of: masks)
    #expect(estimated.count >= 18 && estimated["view_00.png"] != nil)
    let written = try contents(of: folder.url.appendingPathComponent("written"))
    #expect(written.keys.sorted() == estimated.keys.sorted())
    let date = try modificationDate("view_00.png")

    let second = try run("second.usdz")
    #expect(second.model == first.model)
    #expect(try contents(of: masks) == estimated)
    #expect(try modificationDate("view_00.png") == date)
    func noted(_ report: RunReport) throws -> Double {
      try #require(report.stages.first { $0.name == "objectMasking" }?.counts["masks"])
    }
    #expect(try noted(second.report) == noted(first.report))

    // Without one mask and the surface that was made with it.
    for name in ["masks/view_03.png", "mesh/surface.ply"] {
      try FileManager.default.removeItem(at: checkpoint.appendingPathComponent(name))
    }
    let third = try run("third.usdz")
    #expect(try contents(of: masks) == estimated)
    #expect(try modificationDate("view_00.png") != date)
    #expect(third.model == first.model)
  }
}
