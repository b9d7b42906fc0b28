import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct CorrespondenceUnitsTests {
  private func units(_ scene: SyntheticScene, in folder: URL) throws -> CorrespondenceUnits {
    try CorrespondenceUnits(
      UnitStore(folder: folder, isWritten: true),
      featureKeys: scene.features.indices.map { UInt64($0) }, PairSelection.Options(),
      ordering: .unordered, positions: scene.photos.map(\.position))
  }

  /// More than a block of pairs.
  @Test func matchesInBlocksAreTheSame() throws {
    let scene = CorrespondenceSearchTests.scene(photos: 34)
    let pairs = scene.photos.indices.flatMap { first in
      ((first + 1)..<scene.photos.count).map { PhotoPair(ID(first), ID($0)) }
    }
    #expect(MatchBlock.ranges(of: pairs).map(\.count) == [500, 61])
    let temporary = try TemporaryFolder()
    let units = try units(scene, in: temporary.url)
    let matching = FeatureMatching()
    let whole = try matching.run(pairs, features: scene.features, StageContext())
    let made = try matching.run(pairs, features: scene.features, units: units, StageContext())
    #expect(made == whole)
    let empty = [FeatureSet](repeating: FeatureSet(), count: scene.features.count)
    let found = try matching.run(pairs, features: empty, units: units, StageContext())
    #expect(found == whole)
  }

  @Test func searchFindsWhatOthersMade() throws {
    let scene = CorrespondenceSearchTests.scene()
    let temporary = try TemporaryFolder()
    var search = CorrespondenceSearch()
    let camera = CorrespondenceSearchTests.exif(scene)
    let whole = try search.run(
      photos: scene.photos, cameras: [camera], features: scene.features, ordering: .unordered,
      StageContext())
    search.units = try units(scene, in: temporary.url)
    for _ in 0..<2 {
      let parts = try search.run(
        photos: scene.photos, cameras: [camera], features: scene.features, ordering: .unordered,
        StageContext())
      #expect(parts.viewGraph.pairs.map(\.matches) == whole.viewGraph.pairs.map(\.matches))
    }
    let names = try FileManager.default.contentsOfDirectory(atPath: temporary.url.path)
    #expect(names.count { $0.hasPrefix("pairs-") } == 1)
    #expect(names.contains { $0.hasPrefix("matches-") })
  }
}
