import Kernels
import SceneModel

/// Chooses the pairs of photos worth matching.
///
/// Few photos: all pairs of which a first look, at the features of the largest scale only, sees some
/// matches. Many photos: for each the partners with the most matches at first look. Photos in order of
/// capture: a window of neighbours that thins out, and where the path comes back to itself.
package struct PairSelection {
  package struct Options: Hashable, Codable, Sendable {
    /// Up to this number of pairs all are taken without a first look, which would lose pairs of photos
    /// from very different distances: their large features aren't the same.
    package var exhaustivePairs = 1300
    /// Features of each photo that the first look matches: those of the largest scale.
    package var prefix = 2048
    /// Ratio of the first look, more permissive than that of the matching.
    package var prefixRatio = 0.8
    /// Matches at first look that a pair needs.
    package var minimumPrefixMatches = 4
    /// Above this number of photos the number of partners is limited.
    package var manyPhotos = 100
    /// Features of the first look among many photos.
    package var prefixAmongMany = 768
    /// Partners of a photo among many.
    package var partners = 30
    /// Distances in the order of capture at which photos are paired.
    package var sequenceSteps = [1, 2, 3, 4, 6, 8, 12, 16]
    /// Photos of a sequence that take part in the search for places where the path returns.
    package var sequenceSamples = 60
    /// Photos before and after that are paired with each other around such a place.
    package var returnWindow = 3

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// The pairs, sorted.
  package func run(
    _ features: [FeatureSet], isSequential: Bool, _ context: StageContext
  ) throws -> [PhotoPair] {
    let photos = features.indices.filter { features[$0].count > 0 }
    let all = pairs(of: photos)
    if isSequential { return try sequence(features, context) }
    if all.count <= options.exhaustivePairs { return all }
    if photos.count <= options.manyPhotos {
      let counts = try firstLook(all, features, prefix: options.prefix, context)
      return zip(all, counts).filter { $1 >= options.minimumPrefixMatches }.map(\.0)
    }
    let counts = try firstLook(all, features, prefix: options.prefixAmongMany, context)
    return bestPartners(all, counts, photoCount: features.count)
  }

  private func pairs(of photos: [Int]) -> [PhotoPair] {
    photos.indices.flatMap { i in
      photos[(i + 1)...].map { PhotoPair(ID(photos[i]), ID($0)) }
    }
  }

  /// How many matches each pair has among the features of the largest scale.
  private func firstLook(
    _ pairs: [PhotoPair], _ features: [FeatureSet], prefix: Int, _ context: StageContext
  ) throws -> [Int] {
    var matching = DescriptorMatching()
    matching.ratio = options.prefixRatio
    return try context.control.parallelMap(pairs.count) { [matching] index in
      let (first, second) = (pairs[index].first.index, pairs[index].second.index)
      return try matching.matches(
        features[first], features[second], prefix: prefix, KernelControl()
      ).count
    }
  }

  /// The pairs that are among the best of one of their photos.
  private func bestPartners(
    _ pairs: [PhotoPair], _ counts: [Int], photoCount: Int
  ) -> [PhotoPair] {
    var candidates = [[Int]](repeating: [], count: photoCount)
    for index in pairs.indices where counts[index] >= options.minimumPrefixMatches {
      candidates[pairs[index].first.index].append(index)
      candidates[pairs[index].second.index].append(index)
    }
    let chosen = candidates.flatMap { indices in
      indices.sorted { (counts[$0], $1) > (counts[$1], $0) }.prefix(options.partners)
    }
    return Set(chosen).sorted().map { pairs[$0] }
  }

  private func sequence(
    _ features: [FeatureSet], _ context: StageContext
  ) throws -> [PhotoPair] {
    let count = features.count
    var chosen: Set<PhotoPair> = []
    for first in 0..<count {
      for step in options.sequenceSteps where first + step < count {
        chosen.insert(PhotoPair(ID(first), ID(first + step)))
      }
    }
    for (first, second) in try returns(features, context) {
      for i in around(first, count) {
        for j in around(second, count) where i != j { chosen.insert(PhotoPair(ID(i), ID(j))) }
      }
    }
    return chosen.filter {
      features[$0.first.index].count > 0 && features[$0.second.index].count > 0
    }
    .sorted()
  }

  /// Photos far apart in the order of capture that share features, and the two ends.
  private func returns(
    _ features: [FeatureSet], _ context: StageContext
  ) throws -> [(Int, Int)] {
    let count = features.count
    guard count > 2 else { return [] }
    let stride = max(1, (count - 1) / options.sequenceSamples + 1)
    let distance = options.sequenceSteps.max() ?? 1
    let samples = pairs(of: Array(Swift.stride(from: 0, to: count, by: stride)))
      .filter { $0.second.index - $0.first.index > distance / 2 }
    let counts = try firstLook(samples, features, prefix: options.prefix, context)
    let found = zip(samples, counts).filter { $1 >= options.minimumPrefixMatches }.map(\.0)
    return [(0, count - 1)] + found.map { ($0.first.index, $0.second.index) }
  }

  private func around(_ photo: Int, _ count: Int) -> ClosedRange<Int> {
    let window = options.returnWindow / 2
    return max(0, photo - window)...min(count - 1, photo + window)
  }
}
