import Kernels
import SceneModel

extension PlacementDetection {
  /// The groups by what photos show of the points that a map predicts, by pairs that show two
  /// motions, and by photos whose matches contradict the map.
  ///
  /// Photos taken before and after a move have nearly the same pose in a map of the surroundings,
  /// or in one of the object, but show different things; or they have no pose, although they match
  /// points of the map. `neededPoints` is the number of points that determine a pose.
  func groups(
    _ comparisons: [SceneAmbiguityCheck.Comparison], _ reconstruction: Reconstruction,
    _ graph: ViewGraph, _ repetition: RepeatedStructure, neededPoints: Int,
    _ control: KernelControl
  ) throws -> Placements {
    // Matches of a moving object do not depend on its surroundings.
    let motions = graph.omitsSurroundings ? [] : graph.motions
    var links = links(
      of: motions.filter { motion in
        !motion.bodies.contains { repetition.explains($0.matches, of: motion.pair) }
      })
    let moved = MovedPoints(comparisons)
    for comparison in comparisons {
      links[comparison.pair, default: Link()].agreement +=
        moved.count(comparison.present) - options.absenceWeight * moved.count(comparison.absent)
    }
    for (pair, count) in moved.covisibility(reconstruction) {
      links[pair, default: Link()].agreement += count
    }
    let contradicting = graph.contradictingMatches(
      reconstruction, repetition.pointOfFeature, neededPoints: neededPoints)
    for (pair, count) in contradicting {
      links[pair, default: Link()].agreement -= count
    }
    for pair in graph.pairs where reconstruction.isPosedAlike(pair.pair) {
      links[pair.pair, default: Link()].matches += pair.matches.count
    }
    return try groups(links, photoCount: graph.photoCount, control)
  }
}

extension ViewGraph {
  /// The number of matches with points of a map, by pair, of the photos that match enough points
  /// for a pose, but have none: what they show contradicts the map.
  ///
  /// Photos that match fewer points merely overlap too little.
  fileprivate func contradictingMatches(
    _ reconstruction: Reconstruction, _ pointOf: [[Int32]], neededPoints: Int
  ) -> [PhotoPair: Int] {
    var counts: [PhotoPair: Int] = [:]
    var points = [Set<Int32>](repeating: [], count: photoCount)
    for pair in pairs where !reconstruction.isPosedAlike(pair.pair) {
      let isFirstPosed = reconstruction.poses[pair.pair.first.index] != nil
      let (posed, other) =
        isFirstPosed ? (pair.pair.first, pair.pair.second) : (pair.pair.second, pair.pair.first)
      let matched = pair.matches.map {
        pointOf[posed.index][Int(isFirstPosed ? $0.first : $0.second)]
      }.filter { $0 >= 0 }
      counts[pair.pair] = matched.count
      points[other.index].formUnion(matched)
    }
    return counts.filter { pair, count in
      count > 0
        && max(points[pair.first.index].count, points[pair.second.index].count) >= neededPoints
    }
  }
}

extension Reconstruction {
  /// Whether both photos have a pose, or neither has.
  fileprivate func isPosedAlike(_ pair: PhotoPair) -> Bool {
    (poses[pair.first.index] == nil) == (poses[pair.second.index] == nil)
  }
}
