import Foundation
import SceneModel
import Testing

@testable import Pipeline
@testable import RealityFoundation

/// From a session's configuration to the options of the stages.
@Suite struct ConfigurationTests {
  typealias Session = PhotogrammetrySession

  @Test func optionsReachTheirStages() {
    var configuration = Session.Configuration()
    configuration.sampleOrdering = .sequential
    configuration.featureSensitivity = .high
    configuration.isObjectMaskingEnabled = false
    configuration.meshPrimitive = .quad
    configuration.checkpointDirectory = URL(filePath: "/tmp/work/")
    var options = EngineOptions()
    options.threadCount = 3
    options.closesObject = false
    options.refinesSurface = true
    options.knownDistances = [KnownDistance(from: .camera("a"), to: .camera("b"), meters: 1)]
    options.maskFolder = URL(filePath: "/tmp/masks/")
    let result = PipelineConfiguration(configuration, options)
    #expect(result.alignment.ordering == .sequential)
    #expect(result.alignment.features.sensitivity == .high)
    #expect(result.alignment.worldAlignment.knownDistances == options.knownDistances)
    #expect(!result.ingestion.inspection.usesMasks && !result.meshGeneration.isolatesObject)
    #expect(result.ingestion.maskFolder == options.maskFolder)
    #expect(!result.meshGeneration.closesObject && result.photoRefinement != nil)
    #expect(result.meshPrimitive == .quad && result.threadCount == 3)
    #expect(result.checkpointDirectory == configuration.checkpointDirectory)
  }

  @Test func theDefaultIsThatOfTheCommands() {
    var expected = PipelineConfiguration()
    expected.threadCount = EngineOptions().threadCount
    #expect(PipelineConfiguration(Session.Configuration(), EngineOptions()) == expected)
  }

  @Test func theMemorySetsTheLimits() {
    let machine = Machine(totalMemoryBytes: 2 << 30)
    Machine.$override.withValue(machine) {
      let configuration = PipelineConfiguration(Session.Configuration(), EngineOptions())
      #expect(configuration.ingestion.maximumPhotos == 268)
      #expect(configuration.ingestion.inspection.limits.maximumSide == 8192)
      #expect(configuration.imageMemory == 256 << 20)
    }
    let limits = Session.Limits(machine.limits)
    #expect(limits.maximumNumberOfInputImages == 268 && limits.maximumInputImageDimension == 8192)
    #expect(
      Session.limits.maximumNumberOfInputImages == Machine.current.limits.maximumPhotos)
    #expect(PhotogrammetrySession.isSupported)
  }

  @Test(
    arguments: zip(
      [Session.Request.Detail.preview, .reduced, .medium, .full, .raw], DetailLevel.allCases))
  func detailLevelsHaveOneSpecification(detail: Session.Request.Detail, level: DetailLevel) {
    #expect(DetailLevel(detail) == level)
    #expect(DetailSpecification(detail, custom: .init()) == DetailSpecification(level))
  }

  @Test func customDetailHasNoLevel() {
    var custom = Session.Configuration.CustomDetailSpecification()
    custom.maximumPolygonCount = 1234
    #expect(DetailLevel(Session.Request.Detail.custom) == nil)
    #expect(DetailSpecification(.custom, custom: custom).maximumTriangles == 1234)
  }
}
