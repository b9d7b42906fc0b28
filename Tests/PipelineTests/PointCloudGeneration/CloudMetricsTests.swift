import Kernels
import Pipeline
import SceneModel
import Testing

@Suite struct CloudMetricsTests {
  /// A block of 20 × 10 × 5 points, 0.1 apart, and one outlier.
  private let cloud: PointCloud = {
    var cloud = PointCloud()
    for index in 0..<1000 {
      let (x, y, z) = (index % 20, index / 20 % 10, index / 200)
      cloud.positions.append(SIMD3(Float(x), Float(y), Float(z)) * 0.1)
    }
    cloud.positions.append([500, 500, 500])
    cloud.footprints = cloud.positions.map { _ in 0.1 }
    return cloud
  }()

  private func reconstruction(
    _ positions: [SIMD3<Double>], _ scale: WorldFrame.Scale
  ) -> Reconstruction {
    Reconstruction(
      cameras: [], photos: [], poses: [], points: positions.map { ScenePoint(position: $0) },
      worldFrame: WorldFrame(scale: scale))
  }

  @Test func metricsAreThoseOfTheBlock() throws {
    // On a point, within three footprints of one, and beyond.
    let sparse: [SIMD3<Double>] = [[0.5, 0.5, 0.2], [0.5, -0.29, 0.2], [0.5, -0.31, 0.2]]
    let notes = StageNotes()
    let values = try CloudMetrics().run(
      cloud, reconstruction(sparse, .gps), StageContext(control: KernelControl(), notes: notes))
    #expect(values.points == 1001 && values.sparsePoints == 3)
    #expect(values.sparseCoverage == 2.0 / 3)
    #expect(values.pointsPerSparsePoint == 1001.0 / 3)
    let density = try #require(values.pointsPerCubicMeter)
    #expect(abs(density - 1000 / (1.9 * 0.9 * 0.4)) < 0.1)
    #expect(notes.counts["sparseCoverage"] == values.sparseCoverage)
    #expect(notes.counts["pointsPerCubicMeter"] == density)
    #expect(notes.details.count == 1)
  }

  @Test func densityNeedsAUnitAndAVolume() throws {
    let arbitrary = try CloudMetrics().run(
      cloud, reconstruction([[0, 0, 0]], .arbitrary), StageContext())
    #expect(arbitrary.pointsPerCubicMeter == nil)
    var flat = cloud
    for index in flat.positions.indices { flat.positions[index].z = 2 }
    let values = try CloudMetrics().run(flat, reconstruction([], .given), StageContext())
    #expect(values.pointsPerCubicMeter == nil)
    #expect(values.sparseCoverage == 0)
    let empty = try CloudMetrics().run(
      PointCloud(), reconstruction([[0, 0, 0]], .gps), StageContext())
    #expect(empty.points == 0 && empty.sparsePoints == 1 && empty.sparseCoverage == 0)
    #expect(empty.pointsPerCubicMeter == nil && empty.pointsPerSparsePoint == 0)
  }

  @Test func nonFinitePointsAreSkipped() throws {
    var broken = cloud
    broken.positions[0] = [.nan, .infinity, 0]
    broken.positions[1] = [-1e30, 0, 0]
    let values = try CloudMetrics().run(
      broken, reconstruction([[0.5, 0.5, 0.2], [.nan, 0, 0]], .arbitrary), StageContext())
    #expect(values.sparseCoverage == 0.5)
  }

  @Test func sharesAreThoseOfASample() throws {
    // Half of the sparse points, one after the other, are far from the cloud.
    let sparse = (0..<1000).map { SIMD3<Double>($0 % 2 == 0 ? 0.5 : -9, 0.5, 0.2) }
    func values(sampleSize: Int) throws -> CloudMetrics.Values {
      var options = CloudMetrics.Options()
      options.sampleSize = sampleSize
      return try CloudMetrics(options).run(cloud, reconstruction(sparse, .gps), StageContext())
    }
    let all = try values(sampleSize: 2000)
    #expect(all.sparseCoverage == 0.5)
    // Every fifth of them: 100 of 200 are near; and 201 of the points of the block.
    let some = try values(sampleSize: 249)
    #expect(some.sparseCoverage == 0.5 && some.points == 1001 && some.sparsePoints == 1000)
    let (density, expected) = try (
      #require(some.pointsPerCubicMeter), #require(all.pointsPerCubicMeter)
    )
    #expect(abs(density / expected - 1) < 0.3)
  }
}
