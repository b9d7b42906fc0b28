import Evaluation
import Formats
import Foundation
import Pipeline
import SceneModel
import TestLevels
import TestSupport
import Testing

/// The quality that results of the fixtures must not fall below, in `Fixtures/floors.json`.
@Suite(.endToEnd, .serialized) struct GoldenFloorTests {
  struct Floor: Decodable, Sendable, CustomTestStringConvertible {
    var set: String
    var detail: DetailLevel
    /// Number of photos with a pose.
    var registered: Int
    /// Upper bounds of the mean reprojection error, the error of camera centers in meters, and the
    /// mean error of rotations.
    var reprojectionPixels: Double
    var centerRMSE: Double
    var rotationDegrees: Double
    /// Lower bounds of the scores of the surface at `threshold`, in meters.
    var threshold: Double
    var fScore: Double
    var recall: Double

    var testDescription: String { self.set }

    static let all: [Floor] = {
      let file = Fixtures.folder("floors.json")
      return (try? JSONDecoder().decode([Floor].self, from: Data(contentsOf: file))) ?? []
    }()
  }

  @Test func theFileHasFloors() { #expect(Floor.all.map(\.set) == ["orbit", "relief"]) }

  @Test(arguments: Floor.all) func resultsAreAboveTheirFloors(_ floor: Floor) throws {
    let pipeline = ReconstructionPipeline(
      .photos(in: Fixtures.images(of: floor.set)), configuration: PipelineConfiguration())
    let reconstruction = try pipeline.align()
    let truth = Fixtures.folder(floor.set).appendingPathComponent("gt")
    let cameras = try NamedCamera.cameras(
      json: Data(contentsOf: truth.appendingPathComponent("cameras.json")))
    let (errors, alignment) = try PoseErrors.comparing(
      NamedCamera.cameras(of: reconstruction), with: cameras)
    #expect(errors.registered >= floor.registered)
    #expect(errors.centerRMSE <= floor.centerRMSE)
    #expect(errors.rotationMeanDegrees <= floor.rotationDegrees)
    #expect(reconstruction.meanReprojectionError <= floor.reprojectionPixels)

    var options = SurfaceComparison.Options()
    options.thresholds = [floor.threshold]
    options.maximumDistance = 10 * floor.threshold
    options.resultSamples = 100_000
    let comparison = SurfaceComparison(options)
    let scores = try comparison.run(
      try pipeline.surface(for: DetailSpecification(floor.detail)), alignment,
      reference: comparison.reference(
        try PLY.readMesh(truth.appendingPathComponent("mesh.ply")), cameras: cameras))
    #expect(scores.thresholds[0].fScore >= floor.fScore)
    #expect(scores.thresholds[0].recall >= floor.recall)
  }
}
