import SceneModel
import Testing

@testable import Pipeline

@Suite struct RayTargetsTests {
  private func cloud(_ range: Range<Int>) -> PointCloud {
    PointCloud(
      positions: range.map { [Float($0), 0, 0] }, normals: range.map { _ in [0, 1, 0] },
      colors: range.map { _ in .zero }, consistency: range.map { _ in 1 },
      footprints: range.map { _ in 1 }, photoOffsets: (0...range.count).map { UInt32($0) },
      photoIndices: range.map { UInt16($0 % 7) })
  }

  private func numbers(_ clouds: [PointCloud], most: Int) -> [Int] {
    var trimming = SurfaceTrimming()
    trimming.options.maximumRayPoints = most
    let targets = trimming.rayTargets(in: clouds)
    // Those of these targets are all of them.
    #expect(trimming.rayTargets(in: [targets]).positions == targets.positions)
    return targets.positions.map { Int($0.x) }
  }

  /// Whether they are in one cloud or in several, and whatever was left out before.
  @Test func targetsAreEvenlyChosen() {
    for count in 0..<60 {
      let step = max(1, count / 10)
      let expected = Array(stride(from: 0, to: count, by: step))
      #expect(numbers([cloud(0..<count)], most: 10) == expected)
      let parts = [cloud(0..<count / 3), cloud(count / 3..<count)]
      #expect(numbers(parts, most: 10) == expected)
    }
  }
}
