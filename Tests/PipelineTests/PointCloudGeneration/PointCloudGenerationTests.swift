import Foundation
import Kernels
import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct PointCloudGenerationTests {
  static func run(
    _ scene: RaycastScene, _ reconstruction: Reconstruction? = nil, threads: Int = 1,
    notes: StageNotes = StageNotes(), flag: CancellationFlag = CancellationFlag()
  ) throws -> PointCloud {
    let context = StageContext(
      control: KernelControl(threadCount: threads, flag: flag), notes: notes)
    return try PointCloudGeneration().run(
      reconstruction ?? scene.reconstruction, images: ImageStore(images: scene.views.map(\.image)),
      context)
  }

  @Test func threadCountDoesNotChangeTheCloud() throws {
    let scene = RaycastScene()
    let notes = StageNotes()
    let one = try Self.run(scene, threads: 1, notes: notes)
    let two = try Self.run(scene, threads: 2)
    #expect(one.count > 3000)
    #expect(one.positions == two.positions)
    #expect(one.normals == two.normals)
    #expect(one.colors == two.colors)
    #expect(one.consistency == two.consistency)
    #expect(one.photoIndices == two.photoIndices)
    #expect(one.footprints.allSatisfy { $0 > 0 && $0 < 0.1 })
    #expect(notes.counts["points"] == Double(one.count))
    #expect(notes.counts["views"] == 5)
  }

  @Test(arguments: [2, 3]) func fewPhotosAreEnough(count: Int) throws {
    var options = RaycastScene.Options()
    options.viewCount = count
    let scene = RaycastScene(options)
    let cloud = try Self.run(scene)
    #expect(cloud.count > 1000)
    let distances = cloud.positions.map { scene.distance(to: SIMD3<Double>($0)) }.sorted()
    #expect(distances[distances.count * 9 / 10] < 0.06)
  }

  @Test func unregisteredPhotosAreSkipped() throws {
    let scene = RaycastScene()
    var reconstruction = scene.reconstruction
    reconstruction.poses[4] = nil
    let cloud = try Self.run(scene, reconstruction)
    #expect(cloud.count > 2000)
    #expect(!cloud.photoIndices.contains(4))
  }

  @Test func photosWithoutCommonPointsHaveNoSurface() throws {
    let scene = RaycastScene()
    var reconstruction = scene.reconstruction
    reconstruction.points = []
    #expect(throws: PipelineError.self) { try Self.run(scene, reconstruction) }
  }

  @Test func untexturedSurfaceIsAnError() throws {
    var options = RaycastScene.Options()
    options.isUniform = true
    options.hasBall = false
    options.floorExtent = 40
    let scene = RaycastScene(options)
    #expect(throws: PipelineError.self) { try Self.run(scene) }
  }

  @Test func invalidPosesAndPointsAreIgnored() throws {
    let scene = RaycastScene()
    var reconstruction = scene.reconstruction
    reconstruction.poses[0]?.translation = SIMD3(repeating: .nan)
    reconstruction.points[3].position = SIMD3(repeating: .infinity)
    let cloud = try Self.run(scene, reconstruction)
    #expect(cloud.count > 1000)
    #expect(cloud.positions.allSatisfy { $0.x.isFinite && $0.y.isFinite && $0.z.isFinite })
  }

  @Test func cancellationStops() throws {
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) { try Self.run(RaycastScene(), flag: flag) }
  }
}
