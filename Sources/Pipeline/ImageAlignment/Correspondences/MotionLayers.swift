import Foundation
import Kernels
import SceneModel

/// Divides features into those of an object and those of its surroundings, between which the object
/// moves: on a turntable, turned by hand, or laid on another side.
///
/// The two motions of a pair of photos do not say which is the object's, but a feature track
/// belongs to the same body in all photos. The tracks decide which motions belong together, and the
/// object is the body that is nearer to the middle of the photos. In front of a camera on a tripod,
/// what does not move is the surroundings.
struct MotionLayers: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Minimum number of tracks by which a pair's motions are assigned to the bodies. Chosen.
    var minimumVotes = 8
    /// Number of times that all pairs are assigned again. Chosen.
    var sweeps = 3
    /// A track belongs to a body if at least this share of its motions does. Measured: found on
    /// captures of seed 7 (docs/experiments/2026-11-moving-objects.md).
    var minimumTrackShare = 0.75
    /// Minimum share of the tracks that must belong to one of the bodies, so that the two motions
    /// are those of bodies and not of repeated structure. Measured: as above.
    var minimumConsistency = 0.8
    /// For the same reason, the minimum share of features whose neighbor in the photo belongs to
    /// the same body. Measured: as above.
    var minimumCoherence = 0.8
    /// Number of features on either side, ordered by x, among which that neighbor is searched for.
    /// Chosen.
    var neighborWindow = 60
    /// Minimum share of the photos that must show the object. Measured: found on captures of seed 7
    /// (docs/experiments/2026-11-moving-objects.md).
    var minimumPhotoShare = 0.5
    /// Minimum number of features of the object in a photo that shows it. Chosen.
    var minimumFeatures = 8
    /// Minimum rotation between the two motions of most pairs, in degrees. Chosen.
    var minimumDegrees = 3.0
    /// A camera was on a tripod if at least this share of the pairs say so. Measured: found on
    /// captures of seed 7 (docs/experiments/2026-11-moving-objects.md).
    var minimumStaticShare = 0.2
    /// If at least this share of the known tracks of a motion belong to the surroundings, all of
    /// its matches do. Measured: as above.
    var minimumMotionShare = 0.8

    init() {}
  }

  var options = Options()

  /// What belongs to the surroundings.
  struct Surroundings: Sendable {
    /// Whether each feature does, by photo.
    var hasFeature: [[Bool]]
    /// The matches of motions that are theirs as a whole.
    var matches: [PhotoPair: Set<FeatureMatch>]
    /// Whether they are at the same pixels in all photos.
    var areStatic: Bool

    /// Whether a match does.
    func contain(_ match: FeatureMatch, of pair: PhotoPair) -> Bool {
      hasFeature[pair.first.index][Int(match.first)]
        || hasFeature[pair.second.index][Int(match.second)]
        || matches[pair]?.contains(match) == true
    }
  }

  /// The features and matches of the surroundings; nil if the photos don't show an object that
  /// moves.
  func surroundings(
    _ graph: ViewGraph, features: [FeatureSet], photos: [Photo], _ context: StageContext
  ) throws -> Surroundings? {
    let turned = graph.motions.count { $0.degrees >= options.minimumDegrees }
    guard !graph.motions.isEmpty, 2 * turned > graph.motions.count else { return nil }
    let tracks = try TrackBuilding().run(graph.withAllMotions, features: features, context)
    let trackOf = tracks.trackOfFeature(features)
    let motions = graph.motions.map { motion in
      motion.bodies.map { body in
        body.matches.compactMap { match -> Int32? in
          let track = trackOf[motion.pair.first.index][Int(match.first)]
          return track >= 0 && track == trackOf[motion.pair.second.index][Int(match.second)]
            ? track : nil
        }
      }
    }
    let hasStatic = graph.motions.hasStaticCamera(minimumShare: options.minimumStaticShare)
    var assignment = BodyAssignment(
      motions, isStatic: graph.motions.map { hasStatic && $0.isFirstStatic },
      trackCount: tracks.count)
    assignment.run(minimumVotes: options.minimumVotes, sweeps: options.sweeps)
    let bodies = (0..<tracks.count).map {
      assignment.body(ofTrack: $0, minimumShare: options.minimumTrackShare)
    }
    let (assigned, certain) = (assignment.assignedTrackCount, bodies.count { $0 != nil })
    let bodyOf: [[Body?]] = trackOf.map { tracks in
      tracks.map { track in track < 0 ? nil : bodies[Int(track)] }
    }
    guard assigned > 0, Double(certain) >= options.minimumConsistency * Double(assigned),
      isCoherent(bodyOf, features)
    else { return nil }
    let object = hasStatic ? Body.second : objectBody(bodyOf, features, photos)
    let shown = bodyOf.count { bodies in
      bodies.count { $0 == object } >= options.minimumFeatures
    }
    guard Double(shown) >= options.minimumPhotoShare * Double(photos.count) else { return nil }
    let hasFeature = bodyOf.map { bodies in bodies.map { $0 == object.other } }
    return Surroundings(
      hasFeature: hasFeature, matches: matches(of: graph, object.other, bodyOf),
      areStatic: hasStatic)
  }

  /// The matches of all motions of a body.
  private func matches(
    of graph: ViewGraph, _ body: Body, _ bodyOf: [[Body?]]
  ) -> [PhotoPair: Set<FeatureMatch>] {
    var result: [PhotoPair: Set<FeatureMatch>] = [:]
    for motion in graph.withAllMotions.pairs {
      let bodies = motion.matches.map { bodyOf[motion.pair.first.index][Int($0.first)] }
      let (ofBody, known) = (bodies.count { $0 == body }, bodies.count { $0 != nil })
      if known >= options.minimumVotes, Double(ofBody) >= options.minimumMotionShare * Double(known)
      {
        result[motion.pair, default: []].formUnion(motion.matches)
      }
    }
    return result
  }

  // MARK: Decisions

  /// Whether features of the same body are neighbors in the photos.
  private func isCoherent(_ bodyOf: [[Body?]], _ features: [FeatureSet]) -> Bool {
    var (same, all) = (0, 0)
    for (bodies, set) in zip(bodyOf, features) {
      let labeled = bodies.indices.filter { bodies[$0] != nil }
      let sorted = labeled.sorted {
        (set.positions[$0].x, set.positions[$0].y) < (set.positions[$1].x, set.positions[$1].y)
      }
      for (place, index) in sorted.enumerated() {
        // The nearest of the features with a similar x.
        let window = options.neighborWindow
        let others = sorted[max(0, place - window)..<min(sorted.count, place + window + 1)]
        let nearest = others.filter { set.positions[$0] != set.positions[index] }.min {
          distance(set, $0, index) < distance(set, $1, index)
        }
        guard let nearest else { continue }
        all += 1
        if bodies[nearest] == bodies[index] { same += 1 }
      }
    }
    return Double(same) >= options.minimumCoherence * Double(all)
  }

  private func distance(_ set: FeatureSet, _ a: Int, _ b: Int) -> Float {
    let offset = set.positions[a] - set.positions[b]
    return (offset * offset).sum()
  }

  /// The body whose features are nearer to the middle of most photos.
  private func objectBody(
    _ bodyOf: [[Body?]], _ features: [FeatureSet], _ photos: [Photo]
  ) -> Body {
    var votes = 0
    for (photo, bodies) in zip(photos, bodyOf) {
      let middle = SIMD2(Float(photo.width), Float(photo.height)) / 2
      func spread(_ body: Body) -> Float? {
        let distances = bodies.indices.filter { bodies[$0] == body }.map {
          let offset = features[photo.id.index].positions[$0] - middle
          return (offset * offset).sum()
        }
        return distances.count >= options.minimumFeatures ? distances.upperMedian : nil
      }
      guard let first = spread(.first), let second = spread(.second) else { continue }
      votes += second < first ? 1 : -1
    }
    return votes >= 0 ? .second : .first
  }
}

extension [TwoMotions] {
  /// Whether enough of the pairs are of a camera that did not move.
  fileprivate func hasStaticCamera(minimumShare: Double) -> Bool {
    let still = count(where: \.isFirstStatic)
    return still > 0 && Double(still) >= minimumShare * Double(count)
  }
}

extension TwoMotions {
  /// The angle between the rotations of the two motions, in degrees.
  fileprivate var degrees: Double {
    let rotations = bodies.map { $0.secondFromFirst?.rotation ?? .identity }
    return (rotations[0].conjugate * rotations[1]).angle * 180 / .pi
  }
}

extension ViewGraph {
  /// The graph with both motions of each pair.
  fileprivate var withAllMotions: ViewGraph {
    let moving = Set(motions.map(\.pair))
    var result = self
    result.pairs = pairs.filter { !moving.contains($0.pair) } + motions.flatMap(\.bodies)
    return result
  }
}

extension FeatureTracks {
  /// The track of each feature, by photo; −1 without one.
  fileprivate func trackOfFeature(_ features: [FeatureSet]) -> [[Int32]] {
    var result = features.map { [Int32](repeating: -1, count: $0.count) }
    for index in photos.indices {
      result[Int(photos[index])][Int(self.features[index])] = trackOfObservation[index]
    }
    return result
  }
}
