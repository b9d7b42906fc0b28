import Foundation
import Testing

@testable import Pipeline
@testable import RealityFoundation

@Suite struct RunPlanTests {
  typealias Session = PhotogrammetrySession

  private func model(_ name: String, _ detail: Session.Request.Detail) -> Session.Request {
    .modelFile(url: URL(fileURLWithPath: "/tmp/\(name).usdz"), detail: detail)
  }

  @Test func cheapestRequestsComeFirst() {
    let requests = [
      model("m", .medium), .bounds, model("p", .preview), .pointCloud, .poses, .poses,
    ]
    let plan = RunPlan(requests, configuration: .init())
    #expect(
      plan.entries.map(\.request)
        == [.poses, .pointCloud, .bounds, model("p", .preview), model("m", .medium)])
    #expect(plan.requests == Array(requests.dropLast()))
    #expect(plan.finest == DetailSpecification(.medium))
  }

  @Test func posesStopAfterAlignment() {
    let plan = RunPlan([.poses], configuration: .init())
    #expect(plan.units == [.preProcessing, .alignment])
    #expect(RunPlan([.pointCloud], configuration: .init()).units.last == .densification)
  }

  @Test func sharedStagesAreDoneOnce() {
    let plan = RunPlan([model("a", .reduced), model("b", .preview)], configuration: .init())
    #expect(plan.units.count == 5 + 2 * 2)
    #expect(
      plan.units.prefix(5) == [
        .preProcessing, .alignment, WorkUnit(stage: .objectMasking), .densification,
        WorkUnit(stage: .meshGeneration),
      ])
  }

  /// Until the finest model is complete, the others are made, too.
  @Test func workIncludesThatOfEarlierEntries() {
    let plan = RunPlan(
      [model("m", .medium), .poses, model("p", .preview)], configuration: .init())
    #expect(plan.entries.map(\.work.count) == [2, 7, 9])
    #expect(plan.entries.last?.work == plan.units)
    #expect(plan.lastFile == model("m", .medium))
    #expect(RunPlan([.poses], configuration: .init()).lastFile == nil)
  }

  @Test func customDetailFollowsTheConfiguration() {
    var configuration = Session.Configuration()
    configuration.customDetailSpecification.maximumPolygonCount = 60_000
    configuration.customDetailSpecification.maximumTextureDimension = .eightK
    configuration.customDetailSpecification.outputTextureMaps = [.diffuseColor, .displacement]
    configuration.customDetailSpecification.textureFormat = .jpeg(compressionQuality: 7)
    let plan = RunPlan([model("c", .custom)], configuration: configuration)
    let expected = DetailSpecification(
      maximumTriangles: 60_000, textureSide: 8192, maps: [.diffuseColor, .displacement],
      textureFormat: .jpeg(quality: 1), viewPixels: DetailSpecification(.medium).viewPixels)
    #expect(plan.entries.first?.specification == expected)
    configuration.customDetailSpecification.maximumPolygonCount = .max
    let largest = RunPlan([model("c", .custom)], configuration: configuration)
    #expect(largest.finest.viewPixels == DetailSpecification(.raw).viewPixels)
  }

  @Test func entitiesAreOrderedByDetail() {
    let coarse = Session.Request.modelEntity(detail: .preview)
    let plan = RunPlan(
      [model("m", .reduced), .modelEntity(detail: .medium), coarse, .bounds],
      configuration: .init())
    #expect(
      plan.entries.map(\.request)
        == [.bounds, coarse, model("m", .reduced), .modelEntity(detail: .medium)])
    #expect(plan.entries[1].units.last?.stage == .textureMapping)
    #expect(plan.specifications.count == 4)
  }
}
