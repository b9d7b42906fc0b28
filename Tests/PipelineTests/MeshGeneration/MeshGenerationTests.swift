import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

@testable import Pipeline

@Suite struct MeshGenerationTests {
  func ball(
    photoCount: Int = 16, keeps: (SIMD3<Double>) -> Bool = { _ in true }
  ) -> (PointCloud, Reconstruction) {
    var scene = IsolationScene()
    scene.photoCount = photoCount
    let reconstruction = scene.reconstruction(target: .zero)
    // All sides of the ball have points, including those that no photo sees.
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(
      center: .zero, radius: 0.5, label: 1, centers: centers + centers.map { -$0 }, keeps: keeps)
    return (withVisibility(scene.cloud) { $1 < photoCount }, reconstruction)
  }

  /// The cloud with the photos for which `sees` is true.
  func withVisibility(
    _ all: PointCloud, sees: (SIMD3<Double>, Int) -> Bool
  ) -> PointCloud {
    var cloud = all
    cloud.photoIndices = []
    for index in 0..<cloud.count {
      let point = SIMD3<Double>(cloud.positions[index])
      let seen = all.visiblePhotos(of: index).filter { sees(point, Int($0)) }
      cloud.photoIndices.append(contentsOf: seen)
      cloud.photoOffsets[index + 1] = UInt32(cloud.photoIndices.count)
    }
    return cloud
  }

  func isHidden(
    _ point: SIMD3<Double>, from center: SIMD3<Double>, byBallAt middle: SIMD3<Double>,
    radius: Double
  ) -> Bool {
    let direction = (center - point).normalized
    let along = (middle - point).dot(direction)
    return along > 0 && (point + along * direction - middle).length < radius
  }

  /// Number of edges with only one face.
  func openEdges(_ mesh: Mesh) -> Int {
    var edges = Set<SIMD2<UInt32>>()
    for t in mesh.triangles {
      for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] {
        if edges.remove([b, a]) == nil { edges.insert([a, b]) }
      }
    }
    return edges.count
  }

  /// The volume of the ball below a height above its center.
  func volumeOfBall(under height: Double) -> Double {
    let h = 0.5 + height
    return .pi * h * h * (0.5 - h / 3)
  }

  @Test func ballIsRoundClosedAndOrientedOutward() throws {
    let (cloud, _) = ball()
    let mesh = try PoissonSurface().run(cloud, spacing: 0.02, StageContext()).mesh
    let errors = mesh.positions.map { abs($0.length - 0.5) }
    #expect((errors.max() ?? 1) < 0.005)
    #expect(openEdges(mesh) == 0)
    #expect(abs(mesh.volume / (4 / 3 * .pi * 0.125) - 1) < 0.01)
  }

  @Test func meshHasNormalsAndColorsOfItsPatches() throws {
    let (cloud, reconstruction) = ball()
    let context = StageContext()
    let mesh = try MeshGeneration().run(cloud, reconstruction, context)
    #expect(mesh.normals.count == mesh.positions.count)
    #expect(mesh.colors.allSatisfy { $0 == [200, 100, 50] })
    for (position, normal) in zip(mesh.positions, mesh.normals) {
      #expect(normal.dot(position.normalized) > 0.9)
    }
    #expect(context.notes.counts["triangles"] == Double(mesh.triangles.count))
  }

  @Test(.endToEnd) func threadsDoNotChangeTheMesh() throws {
    let (cloud, reconstruction) = ball()
    let meshes = try [1, 2].map { threads in
      try MeshGeneration().run(
        cloud, reconstruction, StageContext(control: KernelControl(threadCount: threads)))
    }
    #expect(meshes[0].positions == meshes[1].positions)
    #expect(meshes[0].triangles == meshes[1].triangles)
    #expect(meshes[0].colors == meshes[1].colors)
  }

  /// Number of faces that satisfy the predicate.
  func faces(_ mesh: Mesh, where isIncluded: (SIMD3<Float>) -> Bool) -> Int {
    mesh.triangles.count { triangle in
      let (a, b, c) = mesh.corners(of: triangle)
      return isIncluded((a + b + c) / 3)
    }
  }

  func trimmed(
    _ closed: Mesh, _ cloud: PointCloud, _ reconstruction: Reconstruction, fillsLarge: Bool = true
  ) throws -> Mesh {
    var trimming = SurfaceTrimming()
    trimming.options.holeFilling.fillsLarge = fillsLarge
    return try trimming.run(
      closed, samples: cloud, scene: cloud, spacing: 0.02, reconstruction, StageContext())
  }

  @Test func largeHoleIsFilledWithAMembrane() throws {
    // The upper third is missing.
    let (cloud, reconstruction) = ball { $0.y < 0.17 }
    let balloon = try PoissonSurface().run(cloud, spacing: 0.02, StageContext()).mesh
    let isBulge = { (p: SIMD3<Float>) in p.y > 0.28 }
    #expect(faces(balloon, where: isBulge) > 100)
    let closed = try trimmed(balloon, cloud, reconstruction)
    #expect(openEdges(closed) == 0)
    #expect(faces(closed, where: isBulge) == 0)
    // Surface within 2.5 spacings of a sample is supported.
    #expect(closed.volume > 0.99 * volumeOfBall(under: 0.17))
    #expect(closed.volume < 1.01 * volumeOfBall(under: 0.17 + 2.5 * 0.02))
    #expect(openEdges(try trimmed(balloon, cloud, reconstruction, fillsLarge: false)) > 10)
  }

  @Test func fillInFreeSpaceIsRemoved() throws {
    // A pipe: photos see the ground through it.
    let (pipe, reconstruction) = ball { abs($0.y) < 0.25 }
    var ground = IsolationScene()
    ground.addPlane(
      radius: 0.7, label: 0, centers: reconstruction.poses.compactMap { $0?.center })
    var scene = pipe
    for index in 0..<ground.cloud.count {
      scene.append(ground.cloud, index)
      scene.positions[scene.count - 1].y -= 0.4
    }
    let ceiling = try PoissonSurface().run(pipe, spacing: 0.02, StageContext()).mesh
    let isCap = { (p: SIMD3<Float>) in p.x * p.x + p.z * p.z < 0.1 }
    #expect(faces(ceiling, where: isCap) > 100)
    let open = try SurfaceTrimming().run(
      ceiling, samples: pipe, scene: scene, spacing: 0.02, reconstruction, StageContext())
    #expect(faces(open, where: isCap) == 0)
    #expect(openEdges(open) > 10)
  }

  @Test func floatingPartsAreRemoved() throws {
    var (cloud, reconstruction) = ball()
    let count = cloud.count
    for index in stride(from: 0, to: count, by: 30) {
      cloud.append(cloud, index)
      cloud.positions[cloud.count - 1] *= 1.5
    }
    let mesh = try MeshGeneration().run(cloud, reconstruction, StageContext())
    #expect(mesh.positions.allSatisfy { abs($0.length - 0.5) < 0.02 })
  }

  @Test func baseOfABallOnATableIsFilled() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [0, 0.35, 0], radius: 0.5, label: 1, centers: centers) { $0.y > 0 }
    scene.addPlane(radius: 2, label: 0, centers: centers) { $0.x * $0.x + $0.z * $0.z > 0.15 }
    let cloud = withVisibility(scene.cloud) { point, photo in
      !isHidden(point, from: centers[photo], byBallAt: [0, 0.35, 0], radius: 0.49)
    }
    let context = StageContext()
    let mesh = try MeshGeneration().run(cloud, reconstruction, context)
    #expect(context.notes.warnings.isEmpty)
    #expect(openEdges(mesh) == 0)
    #expect(mesh.positions.allSatisfy { $0.y > -0.03 && $0.y < 0.88 })
  }

  @Test func cancellationStopsImmediately() throws {
    let (cloud, reconstruction) = ball()
    let flag = CancellationFlag()
    let control = KernelControl(flag: flag) { if $0 > 0.4 { flag.cancel() } }
    #expect(throws: CancellationError.self) {
      try MeshGeneration().run(cloud, reconstruction, StageContext(control: control))
    }
  }

  @Test(arguments: [0, 3, 99]) func tooFewPointsAreAnError(count: Int) throws {
    let (all, reconstruction) = ball()
    let cloud = all.filtered(by: (0..<all.count).map { $0 < count })
    #expect(throws: PipelineError.self) {
      try MeshGeneration().run(cloud, reconstruction, StageContext())
    }
  }

  @Test func nonFinitePointsAreDropped() throws {
    var (cloud, reconstruction) = ball()
    for index in stride(from: 0, to: cloud.count, by: 50) {
      cloud.positions[index] = [.nan, .infinity, 0]
      cloud.normals[(index + 7) % cloud.count] = [.nan, 0, 0]
      cloud.consistency[(index + 13) % cloud.count] = .nan
      cloud.footprints[(index + 17) % cloud.count] = .nan
    }
    let mesh = try MeshGeneration().run(cloud, reconstruction, StageContext())
    #expect(mesh.positions.allSatisfy { abs($0.length - 0.5) < 0.03 })
    cloud.positions = cloud.positions.map { _ in [.nan, .nan, .nan] }
    #expect(throws: PipelineError.self) {
      try MeshGeneration().run(cloud, reconstruction, StageContext())
    }
  }

  @Test(.endToEnd) func wholeSceneIsKeptWithoutIsolation() throws {
    var scene = IsolationScene()
    let reconstruction = scene.reconstruction()
    let centers = reconstruction.poses.compactMap { $0?.center }
    scene.addBall(center: [0, 0.4, 0], radius: 0.4, label: 1, centers: centers)
    scene.addPlane(radius: 1.5, label: 0, centers: centers)
    var options = MeshGeneration.Options()
    options.isolatesObject = false
    let mesh = try MeshGeneration(options).run(scene.cloud, reconstruction, StageContext())
    #expect(mesh.positions.contains { $0.y > 0.75 })
    #expect(mesh.positions.contains { abs($0.y) < 0.02 && $0.x > 1.4 })
    #expect(mesh.positions.allSatisfy { $0.y > -0.1 })
  }

  @Test func cleaningDropsDegenerateFaces() throws {
    var mesh = Mesh(positions: [
      [0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [9, 9, 9], [.nan, 0, 0], [2, 0, 0],
    ])
    mesh.triangles = [
      Triangle(0, 1, 2), Triangle(1, 3, 2), Triangle(2, 0, 1), Triangle(1, 1, 2),
      Triangle(0, 1, 5), Triangle(0, 1, 6), Triangle(0, 1, 99),
    ]
    let clean = try MeshCleaning().run(mesh, samples: PointCloud(), StageContext())
    #expect(clean.triangles == [Triangle(0, 1, 2), Triangle(1, 3, 2)])
    #expect(clean.positions.count == 4)
    #expect(clean.normals.allSatisfy { $0 == [0, 0, 1] })
    #expect(throws: PipelineError.self) {
      try MeshCleaning().run(Mesh(), samples: PointCloud(), StageContext())
    }
  }
}
