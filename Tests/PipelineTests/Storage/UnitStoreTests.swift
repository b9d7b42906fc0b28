import DamagedInput
import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct UnitStoreTests {
  private let temporary: TemporaryFolder

  init() throws { temporary = try TemporaryFolder() }

  private func store(isWritten: Bool = true) -> UnitStore {
    UnitStore(folder: temporary.url, isWritten: isWritten)
  }

  private func block(_ seed: Int32) -> MatchBlock {
    let matches = [[FeatureMatch(first: seed, second: 2)], [], [.init(first: 3, second: 4)]]
    return MatchBlock(
      matches: matches,
      verdicts: matches.indices.map {
        .rejected(RejectedPair(pair: PhotoPair(ID($0), ID(9)), matches: $0, needed: 20))
      })
  }

  @Test func unitIsMadeOnce() throws {
    let made = try store().value(.matches, madeFrom: 5) { block(1) }
    #expect(made == block(1))
    let found = try store().value(.matches, madeFrom: 5) { block(2) }
    #expect(found == block(1))
    let other = try store().value(.matches, madeFrom: 6) { block(2) }
    #expect(other == block(2))
  }

  @Test func ordinaryRunsReadOnly() throws {
    let made = try store(isWritten: false).value(.matches, madeFrom: 5) { block(1) }
    #expect(made == block(1))
    #expect(try FileManager.default.contentsOfDirectory(atPath: temporary.url.path).isEmpty)
  }

  @Test func damagedUnitIsMadeAgain() throws {
    _ = try store().value(.matches, madeFrom: 5) { block(1) }
    let name = try #require(
      try FileManager.default.contentsOfDirectory(atPath: temporary.url.path).first)
    let file = temporary.url.appendingPathComponent(name)
    let data = try Data(contentsOf: file)
    try data.dropLast(4).write(to: file)
    let again = try store().value(.matches, madeFrom: 5) { block(1) }
    #expect(again == block(1))
    #expect(try Data(contentsOf: file) == data)
  }

  @Test func featuresAreStoredExactly() throws {
    let scene = CorrespondenceSearchTests.scene(photos: 2)
    for set in scene.features + [FeatureSet()] {
      let read = try #require(FeatureSet(unit: try set.unitData()))
      #expect(read.positions == set.positions && read.scales == set.scales)
      #expect(read.orientations == set.orientations && read.colors == set.colors)
      #expect(read.descriptors == set.descriptors)
    }
  }

  @Test func malformedBytesAreRefused() throws {
    let features = CorrespondenceSearchTests.scene(photos: 2).features[0].selecting([0, 1, 2])
    let damagedFeatures = DamagedInput([UInt8](try features.unitData()))
    for copy in damagedFeatures.truncations() where copy != damagedFeatures.bytes {
      #expect(FeatureSet(unit: Data(copy)) == nil)
    }
    let damagedBlock = DamagedInput([UInt8](try block(1).unitData()))
    for copy in damagedBlock.truncations() where copy != damagedBlock.bytes {
      #expect(MatchBlock(unit: Data(copy)) == nil)
    }
    for copy in damagedBlock.mutations(2000, seed: 3, header: 300) {
      _ = MatchBlock(unit: Data(copy))
    }
  }
}
