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

  /// More than two blocks of pairs.
  @Test func matchesInBlocksAreTheSame() throws {
    let scene = CorrespondenceSearchTests.scene(photos: 34)
    let pairs = scene.photos.indices.flatMap { first in
      ((first + 1)..<scene.photos.count).map { PhotoPair(ID(first), ID($0)) }
    }
    #expect(MatchBlock.ranges(of: pairs).map(\.count) == [250, 250, 61])
    let temporary = try TemporaryFolder()
    let units = try units(scene, in: temporary.url)
    let camera = CorrespondenceSearchTests.exif(scene)
    let matching = CorrespondenceSearch.Options().pairMatching(
      photos: scene.photos, cameras: [camera])
    let whole = try matching.run(pairs, features: scene.features, units: nil, StageContext())
    #expect(whole.verdicts.count { if case .verified = $0 { true } else { false } } > 100)
    let made = try matching.run(pairs, features: scene.features, units: units, StageContext())
    #expect(made == whole)
    let empty = [FeatureSet](repeating: FeatureSet(), count: scene.features.count)
    let found = try matching.run(pairs, features: empty, units: units, StageContext())
    #expect(found == whole)
  }

  /// Each kind of verdict survives being stored.
  @Test func verdictsAreStored() throws {
    let matches = [FeatureMatch(first: 1, second: 2), .init(first: 3, second: 4)]
    let pair = PhotoPair(ID(3), ID(7))
    let turned = VerifiedPair(
      pair: pair, model: .homography,
      secondFromFirst: RigidTransform(
        rotation: Quaternion(angle: 0.3, axis: [0, 1, 0]), translation: [0.6, 0, 0.8]),
      matches: [matches[1]], medianAngle: 0.1)
    var unknown = turned
    (unknown.model, unknown.secondFromFirst) = (.fundamental, nil)
    let verdicts: [PairVerification.Verdict] = [
      .verified(turned), .verified(unknown),
      .rejected(RejectedPair(pair: pair, matches: 5, needed: 20)),
      .rejected(RejectedPair(pair: pair, matches: 12, needed: 20, weak: turned)),
    ]
    let block = MatchBlock(
      matches: [matches, [matches[0]], [], matches], verdicts: verdicts, guided: [turned])
    #expect(MatchBlock(unit: try block.unitData()) == block)
  }

  /// The choice from blocks of tested candidates is that of one run.
  @Test(arguments: [SampleOrdering.unordered, .sequential], [30, 1300])
  func choiceOfBlocksIsThatOfOneRun(ordering: SampleOrdering, exhaustivePairs: Int) throws {
    let scene = try PairSelectionTests.scene(.streets, photos: 40)
    var options = PairSelectionTests.options(partners: 10)
    options.exhaustivePairs = exhaustivePairs
    options.preemptiveMatching.features = 300
    let selection = PairSelection(options)
    let whole = try selection.run(scene.features, ordering: ordering, StageContext())
    let made = try selection.candidates(
      scene.features, positions: [], ordering: ordering, StageContext())
    let found = try #require(PairSelection.Candidates(unit: try made.unitData()))
    let promising = try stride(from: 0, to: found.tested.count, by: 70).flatMap { start in
      try selection.test(
        Array(found.tested[start...].prefix(70)), features: scene.features, StageContext())
    }
    let choice = selection.choice(of: found, promising: promising)
    #expect(choice.pairs == whole.pairs && choice.candidates == whole.candidates)
    #expect(choice.sample == whole.sample && choice.mostSimilar == whole.mostSimilar)
    #expect(choice.ordering == whole.ordering)
    #expect(whole.candidates.count > whole.pairs.count)
  }

  /// Other cameras lead to other verdicts.
  @Test func camerasArePartOfWhatAUnitIsMadeFrom() throws {
    let scene = CorrespondenceSearchTests.scene(photos: 3)
    var camera = CorrespondenceSearchTests.exif(scene)
    let first = try CorrespondenceSearch.Options().pairMatching(
      photos: scene.photos, cameras: [camera]
    ).fingerprint
    camera.calibration = .assumed
    let other = try CorrespondenceSearch.Options().pairMatching(
      photos: scene.photos, cameras: [camera]
    ).fingerprint
    #expect(first != other)
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
