import Foundation
import Kernels
import SceneModel
import TestLevels
import TestSupport
import Testing

/// The rendered sets that stand in for those of a publication.
@Suite(.endToEnd) struct TwinSceneTests {
  private static func tiny(
    _ object: TwinObject, seed: UInt64 = 3, photoCount: Int = 8
  ) throws -> TwinScene {
    try TwinScene(object, seed: seed, width: 80, photoCount: photoCount, fineness: 0.25)
  }

  @Test func everyFifthPhotoIsHeldOut() {
    let counts = TwinObject.allCases.map(\.photoCount)
    #expect(counts == [150, 150, 80, 120, 200])
    for count in counts {
      #expect((0..<count).filter(TwinScene.isHeldOut).count == count / 5)
    }
  }

  @Test func namesAreInTheOrderOfCapture() {
    let names = (0..<200).map(TwinScene.name)
    #expect(names == names.sorted())
    #expect(names[7] == "IMG_0007.jpg")
  }

  @Test(arguments: TwinObject.allCases)
  func theSurfaceIsClosedAndStandsOnTheSupport(_ object: TwinObject) throws {
    for seed in UInt64(1)...12 {
      let mesh = try Self.tiny(object, seed: seed, photoCount: 1).scene.object
      // Every edge belongs to as many triangles in one direction as in the other.
      var balance: [SIMD2<UInt32>: Int] = [:]
      for t in mesh.triangles {
        for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] {
          balance[SIMD2(min(a, b), max(a, b)), default: 0] += a < b ? 1 : -1
        }
      }
      #expect(balance.values.allSatisfy { $0 == 0 })
      #expect(mesh.volume > 0)
      #expect(mesh.positions.map(\.y).min() == 0)
    }
  }

  @Test(arguments: zip(TwinObject.allCases, [0.15, 1, 0.12, 0.25, 0.08]))
  func objectsHaveTheSizeOfTheirKind(_ object: TwinObject, _ size: Double) throws {
    for seed in UInt64(1)...3 {
      let bounds = try #require(Self.tiny(object, seed: seed, photoCount: 1).scene.object.bounds)
      #expect(abs(Double((bounds.max - bounds.min).max()) / size - 1) < 0.3)
    }
  }

  @Test(arguments: TwinObject.allCases)
  func objectsFillThePhotosAndAreInsideOfThem(_ object: TwinObject) throws {
    let twin = try TwinScene(object, seed: 5, width: 1000, fineness: 0.25)
    let heights = twin.scene.poses.map { pose -> Double in
      let pixels = twin.scene.object.positions.map {
        twin.scene.camera.project(pose * SIMD3<Double>($0))
      }
      let (low, high) = pixels.reduce((pixels[0], pixels[0])) {
        (pointwiseMin($0.0, $1), pointwiseMax($0.1, $1))
      }
      #expect(min(low.min(), 1000 - high.x, 750 - high.y) > 0)
      return (high.y - low.y) / 750
    }
    let mean = heights.reduce(0, +) / Double(heights.count)
    #expect(mean > 0.3 && mean < 0.6)
  }

  @Test(arguments: TwinObject.allCases)
  func camerasProjectTheObjectIntoItsMask(_ object: TwinObject) throws {
    let scene = try Self.tiny(object).scene
    let mask = scene.mask(2)
    let outside = scene.object.positions.filter { position in
      let pixel = scene.camera.project(scene.poses[2] * SIMD3<Double>(position))
      // Within a pixel, because the mask is that of the pixels' centers.
      let rows = (Int(pixel.y) - 1...Int(pixel.y) + 1).clamped(to: 0...mask.height - 1)
      let columns = (Int(pixel.x) - 1...Int(pixel.x) + 1).clamped(to: 0...mask.width - 1)
      return !rows.contains { row in
        columns.contains { mask.pixels[row * mask.width + $0] > 0 }
      }
    }
    #expect(Double(outside.count) < 0.01 * Double(scene.object.positions.count))
  }

  @Test func theCarIsPhotographedOnOneContinuousWalk() throws {
    let poses = try TwinScene(.toyCar, seed: 2, fineness: 0.25).scene.poses
    let steps = zip(poses, poses.dropFirst()).map { ($0.center - $1.center).length }
    let distance = poses[0].center.length
    #expect(steps.max() ?? 1 < 0.45 * distance)
  }

  @Test(arguments: TwinObject.allCases)
  func theSeedDeterminesShapeAndPhotos(_ object: TwinObject) throws {
    let (one, same, other) = (
      try Self.tiny(object).scene, try Self.tiny(object).scene,
      try Self.tiny(object, seed: 4).scene
    )
    #expect(one.object.positions == same.object.positions)
    #expect(one.poses == same.poses)
    #expect(try one.photo(1).pixels == same.photo(1).pixels)
    #expect(one.object.positions != other.object.positions)
    #expect(try one.photo(1).pixels != other.photo(1).pixels)
  }

  @Test func theNumberOfThreadsDoesNotMatter() throws {
    let meshes = try [1, 2].map { threads in
      try TwinScene(
        .apple, width: 80, photoCount: 1, fineness: 0.25, KernelControl(threadCount: threads)
      ).scene.object
    }
    #expect(meshes[0].positions == meshes[1].positions)
    #expect(meshes[0].triangles == meshes[1].triangles)
  }
}
