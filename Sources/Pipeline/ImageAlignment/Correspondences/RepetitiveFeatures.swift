import Kernels
import SceneModel

/// Finds the features of patterns that repeat in the scene, such as wallpaper, tiles, or the bays
/// of a facade.
///
/// Seen from the same direction, two instances of a pattern look more alike than one instance from
/// two directions: between photos that are far apart, the ratio test prefers the wrong one, and all
/// its matches agree with each other. One photo that shows several instances reveals the pattern:
/// its features look like others of the same photo. (Arnfred and Winkler, "Mirror match", AVSSW
/// 2013, take the second-best match from the same photo, too.)
struct RepetitiveFeatures: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Two features look the same if they are as similar as this share of the verified matches,
    /// which show the same point. Measured: of rendered wallpaper, 87 and 90 % of the features are
    /// repetitive (`wallpaper`, seeds 2 and 3), of the object in front of it none, and of the
    /// matches of 11 real sets without a pattern at most 10 % (a facade).
    var matchShare = 0.75
    /// Minimum share of the features in question that must be repetitive for a pattern to matter,
    /// and the number of features per photo by which that is decided. Measured: 10 % for that
    /// facade, 48 % of the matches of the wallpapers, and of a flower pot on graph paper.
    var minimumShare = 0.2
    var sampleCount = 100

    init() {}
  }

  var options = Options()

  /// The indices of the features that are not repetitive, by photo; nil if there are too few
  /// repetitive ones among the features in question.
  func distinctiveFeatures(
    _ graph: ViewGraph, _ features: [FeatureSet], _ control: KernelControl
  ) throws -> [[Int]]? {
    guard let distance = graph.matchDistance(share: options.matchShare, features) else {
      return nil
    }
    let search = RepetitionSearch(maximumDistance: distance)
    func areRepeated(_ queries: [[Int32]], _ control: KernelControl) throws -> [[Bool]] {
      try control.parallelMap(features.count) { photo in
        try search.areRepeated(queries[photo], of: features[photo], KernelControl())
      }
    }
    let sample = graph.questionableFeatures.map { $0.sample(options.sampleCount) }
    let inSample = try areRepeated(sample, control.part(from: 0, to: 0.1)).joined()
    guard Double(inSample.count { $0 }) >= options.minimumShare * Double(inSample.count) else {
      return nil
    }
    let all = features.map { Array(0..<Int32($0.count)) }
    return try areRepeated(all, control.part(from: 0.1, to: 1)).map { flags in
      flags.indices.filter { !flags[$0] }
    }
  }
}

extension ViewGraph {
  /// The features that a pattern may have matched wrongly, by photo in ascending order: all that
  /// are matched, or, where an object seems to move, those of its surroundings, which may not have
  /// moved if they repeat.
  fileprivate var questionableFeatures: [[Int32]] {
    if omitsSurroundings {
      return surroundings.map { flags in flags.indices.filter { flags[$0] }.map(Int32.init) }
    }
    var found = [Set<Int32>](repeating: [], count: photoCount)
    for pair in pairs {
      found[pair.pair.first.index].formUnion(pair.matches.map(\.first))
      found[pair.pair.second.index].formUnion(pair.matches.map(\.second))
    }
    return found.map { $0.sorted() }
  }

  /// The descriptor distance that a share of the verified matches does not exceed; nil without
  /// matches.
  fileprivate func matchDistance(share: Double, _ features: [FeatureSet]) -> Double? {
    let squared = pairs.flatMap { pair in
      pair.matches.map { match in
        features[pair.pair.first.index].squaredDistance(
          Int(match.first), features[pair.pair.second.index], Int(match.second))
      }
    }.sorted()
    guard !squared.isEmpty else { return nil }
    return Double(squared[Int(share * Double(squared.count - 1))]).squareRoot()
  }
}

extension FeatureSet {
  /// The squared distance of two descriptors.
  fileprivate func squaredDistance(_ index: Int, _ other: FeatureSet, _ otherIndex: Int) -> Int {
    let length = Self.descriptorLength
    return (0..<length).reduce(0) { sum, place in
      let difference =
        Int(descriptors[index * length + place])
        - Int(other.descriptors[otherIndex * length + place])
      return sum + difference * difference
    }
  }
}

extension [Int32] {
  /// At most `maximum` elements at equal distances.
  fileprivate func sample(_ maximum: Int) -> [Int32] {
    count <= maximum ? self : (0..<maximum).map { self[$0 * count / maximum] }
  }
}
