import Foundation
import Kernels
import SceneModel
import Testing

@testable import Pipeline

@Suite struct ObjectFeaturesTests {
  /// A photo of 400 × 200 pixels with a mask of a quarter of that size, which marks x from 160 to
  /// 240 and y from 80 to 120, and the same photo without a mask.
  private func objectFeatures(
    at positions: [SIMD2<Float>], margin: Double
  ) throws -> ObjectFeatures {
    var mask = RasterImage(width: 100, height: 50, channels: 1)
    for y in 20..<30 { for x in 40..<60 { mask.pixels[y * 100 + x] = 255 } }
    let photos = (0..<2).map { index in
      Photo(
        id: ID(index), sampleID: index, name: "\(index).jpg", url: URL(fileURLWithPath: "/"),
        width: 400, height: 200, orientation: 1, camera: ID<Camera>(0))
    }
    let features = FeatureSet(positions: positions)
    return try ObjectFeatures(
      [features, features], photos: photos, masks: [mask, nil], margin: margin, KernelControl())
  }

  @Test func featuresInsideAreOfTheObject() throws {
    let inside: [SIMD2<Float>] = [[160.5, 80.5], [239.5, 119.5], [200, 100]]
    let outside: [SIMD2<Float>] = [[50, 25], [60, 29], [399, 199], [200, 20], [20, 100]]
    let found = try objectFeatures(at: outside + inside, margin: 0)
    #expect(found.isObject[0] == outside.map { _ in false } + inside.map { _ in true })
    #expect(found.indices[0] == [5, 6, 7])
    #expect(found.photos.map(\.id) == [ID(0), ID(1)])
  }

  /// A margin of 3 % of the longer side is 12 pixels; without one it is a pixel of the mask.
  @Test(arguments: [(0.03, 12), (0, 4)] as [(Double, Float)])
  func featuresWithinTheMarginAreOfTheObject(margin: Double, reach: Float) throws {
    func around(_ distance: Float) -> [SIMD2<Float>] {
      [
        [160 - distance, 100], [240 + distance, 100], [200, 80 - distance], [200, 120 + distance],
      ]
    }
    let found = try objectFeatures(at: around(reach - 0.5) + around(reach + 0.5), margin: margin)
    #expect(found.isObject[0] == (0..<8).map { $0 < 4 })
  }

  @Test func photosWithoutAMaskKeepAllFeatures() throws {
    let found = try objectFeatures(at: [[0, 0], [200, 100], [500, 500]], margin: 0.03)
    #expect(found.isObject == [[false, true, false], [true, true, true]])
    #expect(found.indices == [[1], [0, 1, 2]])
    #expect(found.medianCount == 3)
  }
}
