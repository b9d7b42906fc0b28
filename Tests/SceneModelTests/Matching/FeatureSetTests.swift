import SceneModel
import Testing

@Suite struct FeatureSetTests {
  @Test func selectedFeaturesKeepTheirData() {
    let length = FeatureSet.descriptorLength
    let features = FeatureSet(
      positions: [[1, 2], [3, 4], [5, 6]], scales: [1, 2, 3], orientations: [0.1, 0.2, 0.3],
      descriptors: (0..<3).flatMap { [UInt8](repeating: UInt8($0), count: length) },
      colors: [[1, 1, 1], [2, 2, 2], [3, 3, 3]])
    let selected = features.selecting([2, 0])
    #expect(selected.positions == [[5, 6], [1, 2]])
    #expect(selected.scales == [3, 1] && selected.orientations == [0.3, 0.1])
    #expect(selected.colors == [[3, 3, 3], [1, 1, 1]])
    let expected = [UInt8](repeating: 2, count: length) + [UInt8](repeating: 0, count: length)
    #expect(selected.descriptors == expected)
    #expect(features.selecting([]).count == 0)
  }
}
