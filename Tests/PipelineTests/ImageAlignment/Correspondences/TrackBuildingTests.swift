import Pipeline
import SceneModel
import TestSupport
import Testing

@Suite struct TrackBuildingTests {
  private func tracks(
    _ matches: [(Int, Int, [(Int32, Int32)])], photos: Int, featureCount: Int = 4
  ) throws -> FeatureTracks {
    let features = FeatureSet(positions: (0..<featureCount).map { [Float($0), 1] })
    let pairs = matches.map { first, second, matches in
      VerifiedPair(
        pair: PhotoPair(ID(first), ID(second)), model: .essential, secondFromFirst: nil,
        matches: matches.map { FeatureMatch(first: $0.0, second: $0.1) }, medianAngle: 0)
    }
    return try TrackBuilding().run(
      ViewGraph(photoCount: photos, pairs: pairs),
      features: Array(repeating: features, count: photos), StageContext())
  }

  private func members(_ tracks: FeatureTracks, _ track: Int) -> [[Int32]] {
    tracks.observations(of: track).map { [tracks.photos[$0], tracks.features[$0]] }
  }

  @Test func matchesBecomeOneTrack() throws {
    let tracks = try tracks([(0, 1, [(0, 1)]), (1, 2, [(1, 2), (3, 3)])], photos: 3)
    #expect(tracks.count == 2)
    #expect(members(tracks, 0) == [[0, 0], [1, 1], [2, 2]])
    #expect(members(tracks, 1) == [[1, 3], [2, 3]])
    #expect(tracks.observationsOfPhoto == [[0], [1, 3], [2, 4]])
  }

  @Test func matchWithoutSupportDoesNotJoinTwoFeaturesOfAPhoto() throws {
    // 0 and 1 are seen in three photos each; the last match would merge them.
    let tracks = try tracks(
      [(0, 1, [(0, 0), (1, 1)]), (0, 2, [(0, 0), (1, 1), (0, 1)]), (1, 2, [(0, 0), (1, 1)])],
      photos: 3)
    #expect(tracks.count == 2)
    #expect(members(tracks, 0) == [[0, 0], [1, 0], [2, 0]])
    #expect(members(tracks, 1) == [[0, 1], [1, 1], [2, 1]])
  }

  @Test func coincidentFeaturesAreMerged() throws {
    let doubled = FeatureSet(positions: [[5, 5], [5, 5], [7, 7]])
    let graph = ViewGraph(
      photoCount: 2,
      pairs: [
        VerifiedPair(
          pair: PhotoPair(ID(0), ID(1)), model: .essential, secondFromFirst: nil,
          matches: [FeatureMatch(first: 0, second: 0), FeatureMatch(first: 1, second: 1)],
          medianAngle: 0)
      ])
    let tracks = try TrackBuilding().run(
      graph, features: [doubled, doubled], StageContext())
    #expect(tracks.count == 1)
  }

  @Test func outOfRangeMatchesAreIgnored() throws {
    let tracks = try tracks([(0, 1, [(0, 99), (-1, 0), (2, 2)])], photos: 2)
    #expect(tracks.count == 1)
  }

  @Test func noTrackHasAPhotoTwice() throws {
    var options = SyntheticScene.Options()
    options.outlierRatio = 0.4
    let scene = SyntheticScene(options)
    let tracks = try TrackBuilding().run(
      scene.viewGraph, features: scene.features, StageContext())
    #expect(tracks.count > 500)
    for track in 0..<tracks.count {
      let photos = tracks.observations(of: track).map { tracks.photos[$0] }
      #expect(Set(photos).count == photos.count)
      #expect(photos == photos.sorted())
    }
  }
}
