import Foundation
import Pipeline
import SceneModel
import SharedCommands
import TestSupport
import Testing

@testable import EngineCommands

@Suite struct AppliedArgumentsTests {
  @Test func everyGroupOfOptionsIsApplied() throws {
    let temporary = try TemporaryFolder()
    for name in ["masks/a.png", "photos/a.jpg", "photos/b.jpg"] {
      try temporary.write([0], as: name)
    }
    let path = temporary.url.path
    var configuration = PipelineConfiguration()
    try ThreadArguments.parse(["--threads", "3"]).apply(to: &configuration)
    try AlignmentArguments.parse(["-o", "sequential", "-f", "high"]).apply(to: &configuration)
    try MaskArguments.parse(["--masks", path + "/masks"])
      .apply(to: &configuration, areIgnored: true)
    try ScaleArguments.parse(["--camera-distance", "a.jpg,b.jpg=2"])
      .apply(to: &configuration, photos: temporary.url.appendingPathComponent("photos"))
    try PreviewArguments.parse(["--preview", path + "/p.png"]).apply(to: &configuration)
    try ShapeArguments.parse(["--quads"]).apply(to: &configuration)
    #expect(configuration.threadCount == 3)
    #expect(configuration.alignment.ordering == .sequential)
    #expect(configuration.alignment.features.sensitivity == .high)
    #expect(!configuration.isObjectMaskingEnabled)
    #expect(configuration.ingestion.maskFolder?.path == path + "/masks")
    #expect(configuration.alignment.worldAlignment.knownDistances.map(\.meters) == [2])
    #expect(configuration.previewFile?.path == path + "/p.png")
    #expect(configuration.meshPrimitive == .quad)
  }

  @Test func defaultsChangeNothing() throws {
    var configuration = PipelineConfiguration()
    let none: [String] = []
    try ThreadArguments.parse(none).apply(to: &configuration)
    try AlignmentArguments.parse(none).apply(to: &configuration)
    try MaskArguments.parse(none).apply(to: &configuration)
    try ScaleArguments.parse(none).apply(to: &configuration, photos: URL(fileURLWithPath: "/"))
    try PreviewArguments.parse(none).apply(to: &configuration)
    try ShapeArguments.parse(none).apply(to: &configuration)
    #expect(configuration == PipelineConfiguration())
  }

  @Test func levelsHaveTheLimitsOfThePipeline() throws {
    for level in DetailArgument.allCases {
      let expected = DetailSpecification(try #require(DetailLevel(rawValue: level.rawValue)))
      #expect(level.limits == expected)
      #expect(try DetailArguments.parse(["-d", level.rawValue]).limits == expected)
    }
    let custom = try DetailArguments.parse([
      "-d", "custom", "--max-polygons", "900", "--texture-side", "1024", "--maps", "color",
    ]).limits
    #expect(custom.maximumTriangles == 900 && custom.textureSide == 1024)
    #expect(custom.maps == [.diffuseColor])
  }

  @Test(arguments: Ablation.allCases)
  func ablationsChangeTheDenseStage(_ step: Ablation) {
    var options = PointCloudGeneration.Options()
    step.apply(to: &options)
    #expect(options != PointCloudGeneration.Options())
  }
}
