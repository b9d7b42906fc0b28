import Kernels
import SceneModel

/// Image retrieval: finds similar photos without matching them, by VLAD vectors (Jégou et al., CVPR
/// 2010) over a visual vocabulary learned from the photos' descriptors.
package struct PhotoRetrieval: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Number of visual words. Chosen: between the 16 and 256 of Jégou et al. 2010.
    package var words = 128
    /// Number of descriptors, over all photos, that the words are learned from. Chosen.
    package var sampledDescriptors = 40_000
    /// Seed of the vocabulary's clustering. Chosen: any value serves.
    package var seed: UInt64 = 0

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the `partners` photos most similar to each photo, the most similar first; none for a
  /// photo without features.
  package func run(
    _ features: [FeatureSet], partners: Int, _ context: StageContext
  ) throws -> [[Int]] {
    let vocabulary = try VisualVocabulary(
      count: options.words, descriptors: sample(features), seed: options.seed,
      context.part(from: 0, to: 0.3).control)
    let vectors = try context.part(from: 0.3, to: 0.8).control.parallelMap(features.count) {
      try vocabulary.vector(of: features[$0], KernelControl())
    }
    let ranking = try SimilarityRanking(
      vectors: Array(vectors.joined()), photoCount: features.count, neighborCount: partners,
      context.part(from: 0.8, to: 1).control)
    return features.indices.map { photo in
      guard features[photo].count > 0, vocabulary.count > 0 else { return [] }
      return ranking.neighbors(of: photo).filter { features[$0].count > 0 }
    }
  }

  /// Descriptors at regular intervals over all photos.
  private func sample(_ features: [FeatureSet]) -> [UInt8] {
    let length = FeatureSet.descriptorLength
    let count = features.reduce(0) { $0 + $1.count }
    let step = max(1, count / max(1, options.sampledDescriptors))
    var descriptors: [UInt8] = []
    var next = 0
    for set in features {
      while next < set.count {
        descriptors += set.descriptors[next * length..<(next + 1) * length]
        next += step
      }
      next -= set.count
    }
    return descriptors
  }
}
