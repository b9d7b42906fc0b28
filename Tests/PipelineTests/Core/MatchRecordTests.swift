import SceneModel
import Testing

@testable import Pipeline

@Suite struct MatchRecordTests {
  private func pair(_ a: Int, _ b: Int, matches: Int) -> VerifiedPair {
    VerifiedPair(
      pair: PhotoPair(ID(a), ID(b)), model: .essential, secondFromFirst: nil,
      matches: (0..<matches).map { FeatureMatch(first: Int32($0), second: Int32($0)) },
      medianAngle: .pi / 18)
  }

  private func features(_ count: Int) -> FeatureSet {
    FeatureSet(
      positions: [SIMD2<Float>](repeating: .zero, count: count),
      scales: [Float](repeating: 1, count: count),
      orientations: [Float](repeating: 0, count: count),
      descriptors: [UInt8](repeating: 0, count: count * FeatureSet.descriptorLength),
      colors: [SIMD3<UInt8>](repeating: .zero, count: count))
  }

  /// Photos 0, 2 and 3 match, 1 and 4 match, and 0 and 1 share a few features.
  private var record: MatchRecord {
    MatchRecord(
      (0..<5).map { features(10 + $0) },
      ViewGraph(
        photoCount: 5,
        pairs: [pair(0, 2, matches: 7), pair(1, 4, matches: 8), pair(2, 3, matches: 9)],
        rejected: [RejectedPair(pair: PhotoPair(ID(0), ID(1)), matches: 3, needed: 6)]))
  }

  @Test func pairsAreSortedColumns() {
    let record = record
    #expect(record.features == [10, 11, 12, 13, 14])
    #expect(record.first == [0, 0, 1, 2] && record.second == [1, 2, 4, 3])
    #expect(record.matches == [3, 7, 8, 9] && record.needed == [6, 0, 0, 0])
    #expect(record.degrees == [0, 10, 10, 10])
  }

  @Test func rejectedPairsConnectNothing() {
    #expect(record.groups == [[0, 2, 3], [1, 4]])
    #expect(record.partners == [1, 1, 2, 1, 1])
    #expect(MatchRecord().groups.isEmpty && MatchRecord().partners.isEmpty)
  }
}
