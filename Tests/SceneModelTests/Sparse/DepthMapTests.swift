import Foundation
import SceneModel
import Testing

@Suite struct DepthMapTests {
  @Test func eachPixelNeedsADepth() {
    #expect(DepthMap(width: 2, height: 2, depths: [1, 2, 3, 4]) != nil)
    #expect(DepthMap(width: 2, height: 2, depths: [1, 2, 3]) == nil)
    #expect(DepthMap(width: 0, height: 2, depths: []) == nil)
    #expect(DepthMap(width: -1, height: -1, depths: [1]) == nil)
  }

  @Test func placesSelectTheNearestPixel() throws {
    // Within 5 % of each other, so that nothing is an edge.
    let map = try #require(DepthMap(width: 2, height: 2, depths: [1, 1.01, 1.02, 1.03]))
    #expect(map.depth(at: [0, 0]) == Double(Float(1)))
    #expect(map.depth(at: [0.49, 0.49]) == 1 && map.depth(at: [0.5, 0.49]) == Double(Float(1.01)))
    #expect(map.depth(at: [0.1, 0.5]) == Double(Float(1.02)))
    let end = Double(1).nextDown
    #expect(map.depth(at: [end, end]) == Double(Float(1.03)))
  }

  @Test func placesOutsideHaveNoDepth() throws {
    let map = try #require(DepthMap(width: 1, height: 1, depths: [2]))
    #expect(map.depth(at: [0.5, 0.5]) == 2)
    for place in [SIMD2<Double>(-0.01, 0.5), [1, 0.5], [0.5, -0.01], [0.5, 1], [.nan, 0.5]] {
      #expect(map.depth(at: place) == nil)
    }
  }

  @Test(arguments: [0, -1, .nan, .infinity] as [Float]) func unknownDepthsAreNil(depth: Float)
    throws
  {
    let single = try #require(DepthMap(width: 1, height: 1, depths: [depth]))
    #expect(single.depth(at: [0.5, 0.5]) == nil)
    // A neighbor of unknown depth is a sign of an edge.
    let pair = try #require(DepthMap(width: 3, height: 1, depths: [depth, 1, 1]))
    #expect(pair.depth(at: [0.5, 0.5]) == nil && pair.depth(at: [0.9, 0.5]) == 1)
  }

  /// JSON, in which processes pass maps on, has no other numbers than finite ones.
  @Test func unknownDepthsCanBeEncoded() throws {
    let map = try #require(DepthMap(width: 5, height: 1, depths: [2, -1, .nan, .infinity, 0]))
    #expect(map.depths == [2, 0, 0, 0, 0])
    let read = try JSONDecoder().decode(DepthMap.self, from: try JSONEncoder().encode(map))
    #expect(read == map)
  }

  @Test func edgesAreFivePercent() throws {
    let near = try #require(DepthMap(width: 2, height: 1, depths: [100, 104.9]))
    #expect(near.depth(at: [0.2, 0.5]) == 100)
    let far = try #require(DepthMap(width: 2, height: 1, depths: [100, 105.1]))
    #expect(far.depth(at: [0.2, 0.5]) == nil)
    // Relative to the pixel itself: 105.1 − 100 is less than 5 % of 105.1.
    #expect(far.depth(at: [0.8, 0.5]) != nil)
  }

  @Test func diagonalNeighborsCount() throws {
    var depths = [Float](repeating: 1, count: 9)
    depths[0] = 2
    let map = try #require(DepthMap(width: 3, height: 3, depths: depths))
    #expect(map.depth(at: [0.5, 0.5]) == nil && map.depth(at: [0.9, 0.9]) == 1)
  }

  @Test(
    arguments: [
      (1, [1, 2, 3, 4, 5, 6]), (2, [3, 2, 1, 6, 5, 4]), (3, [6, 5, 4, 3, 2, 1]),
      (4, [4, 5, 6, 1, 2, 3]), (5, [1, 4, 2, 5, 3, 6]), (6, [4, 1, 5, 2, 6, 3]),
      (7, [6, 3, 5, 2, 4, 1]), (8, [3, 6, 2, 5, 1, 4]),
    ] as [(Int, [Float])]) func orientationsAreThoseOfEXIF(
      orientation: Int, expected: [Float]
    ) throws
  {
    let map = try #require(DepthMap(width: 3, height: 2, depths: [1, 2, 3, 4, 5, 6]))
    let turned = map.turned(byOrientation: orientation)
    #expect(turned.depths == expected)
    #expect((turned.width, turned.height) == (orientation < 5 ? (3, 2) : (2, 3)))
    let inverse = [1, 2, 3, 4, 5, 8, 7, 6][orientation - 1]
    #expect(turned.turned(byOrientation: inverse) == map)
  }
}
