import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct SilhouettesTests {
  /// Clusters of all sizes, in front of, around and behind the cameras, and points without a place.
  @Test(arguments: [1, 2, 3] as [UInt64])
  func blocksOfPointsAreDecidedAsEachPoint(_ seed: UInt64) throws {
    var random = SplitMix64(seed: seed)
    let scene = RenderedScene.statue(photoCount: 8, upperCount: 3, width: 60, height: 45)
    let masks = scene.poses.map { _ in
      var mask = RasterImage(width: 60, height: 45, channels: 1)
      for pixel in mask.pixels.indices {
        mask.pixels[pixel] = Int.random(in: 0..<20, using: &random) == 0 ? 255 : 0
      }
      return mask
    }
    let images = ImageStore(
      images: scene.poses.map { _ in RasterImage(width: 60, height: 45, channels: 3) },
      masks: masks)
    let silhouettes = try #require(try Silhouettes(scene.reconstruction(), images: images))
    func offset(_ size: Float) -> SIMD3<Float> {
      SIMD3<Float>(
        .random(in: -size...size, using: &random), .random(in: -size...size, using: &random),
        .random(in: -size...size, using: &random))
    }
    var points = (0..<40).flatMap { cluster in
      let center = offset(2)
      return (0..<100).map { _ in center + offset(cluster.isMultiple(of: 2) ? 0.02 : 0.5) }
    }
    points[7] = SIMD3<Float>(repeating: .nan)
    points[8] = SIMD3<Float>(repeating: .infinity)
    let inside = try silhouettes.areInside(points, KernelControl(threadCount: 2))
    #expect(try inside == points.map { try silhouettes.isInside($0) })
    #expect(inside.contains(true) && inside.contains(false))
    #expect(try silhouettes.areInside([], KernelControl()).isEmpty)
  }
}
