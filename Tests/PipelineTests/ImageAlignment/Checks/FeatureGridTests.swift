import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct FeatureGridTests {
  /// A reach below one pixel counts as one.
  @Test(arguments: [0.2, 1, 7.3, 40, 1000])
  func featuresAreThoseOfABruteForceSearch(reach: Double) {
    let (width, height) = (123, 77)
    var random = SeededGenerator(seed: 9)
    func pixel(margin: Double) -> SIMD2<Double> {
      let size = SIMD2(Double(width), Double(height)) + 2 * margin
      return SIMD2(random.uniform(), random.uniform()) * size - margin
    }
    // Refinement may move features slightly out of the photo.
    let positions = (0..<4000).map { _ in SIMD2<Float>(pixel(margin: 0.5)) }
    let grid = FeatureGrid(positions, width: width, height: height, reach: reach)
    #expect(grid.reach == max(1, reach))
    let corners: [SIMD2<Double>] = [[0, 0], [122.999, 0], [0, 76.999], [122.999, 76.999]]
    let pixels = corners + (0..<500).map { _ in pixel(margin: 0) }
    var found = 0
    for pixel in pixels {
      let near = positions.indices.filter {
        (SIMD2<Double>(positions[$0]) - pixel).length <= grid.reach
      }
      #expect(grid.features(near: pixel).sorted() == near)
      found += near.count
    }
    #expect(found > 500)
  }

  /// Even if features are within reach.
  @Test(arguments: [[-0.5, 5], [5, -0.5], [20.5, 5], [5, 20.5], [1e12, 5], [5, -1e12]])
  func pixelsOutsideHaveNoFeatures(pixel: [Double]) {
    let corners: [SIMD2<Float>] = [[0, 5], [5, 0], [19.9, 5], [5, 19.9]]
    let grid = FeatureGrid(corners, width: 19, height: 19, reach: 4)
    #expect(grid.features(near: SIMD2(pixel[0], pixel[1])).isEmpty)
    #expect(grid.features(near: [2, 5]) == [0])
  }

  @Test func withoutFeaturesNoneAreFound() {
    let grid = FeatureGrid([], width: 10, height: 10, reach: 3)
    #expect(grid.features(near: [5, 5]).isEmpty)
  }
}
