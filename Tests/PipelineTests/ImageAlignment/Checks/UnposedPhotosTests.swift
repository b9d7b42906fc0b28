import Kernels
import SceneModel
import TestSupport
import Testing

@testable import Pipeline

/// Photos that a map leaves out were taken of a moved object only if their matches contradict the
/// map.
@Suite struct UnposedPhotosTests {
  private let scene = SyntheticScene()
  private let posed = 0..<7

  /// A map of the first photos, and a graph in which the other ones match up to `matches` features
  /// of each photo of the map.
  private func placements(matchesAcross matches: Int) throws -> Placements {
    var map = try SparseMapping().run(
      scene.viewGraph, features: scene.features, photos: scene.photos, cameras: [scene.camera],
      StageContext())
    for photo in map.poses.indices where !posed.contains(photo) { map.poses[photo] = nil }
    var graph = scene.viewGraph
    for index in graph.pairs.indices {
      let pair = graph.pairs[index].pair
      guard posed.contains(pair.first.index) != posed.contains(pair.second.index) else { continue }
      graph.pairs[index].matches = Array(graph.pairs[index].matches.prefix(matches))
    }
    graph.pairs.removeAll { $0.matches.isEmpty }
    return try PlacementDetection().groups(
      [], map, graph, RepeatedStructure(map, features: scene.features), neededPoints: 30,
      KernelControl())
  }

  @Test func photosThatContradictTheMapAreAPlacement() throws {
    let found = try placements(matchesAcross: .max)
    #expect(found.groups.map(Set.init).contains(Set(posed)))
    #expect(found.groups.count == 2)
  }

  /// Another room; or the back of a facade, which the photos of its corner share a few points with.
  @Test(arguments: [0, 1]) func photosThatOverlapTooLittleAreNone(matches: Int) throws {
    #expect(!(try placements(matchesAcross: matches)).areSeveral)
  }
}
