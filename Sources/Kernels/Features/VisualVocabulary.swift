import CKernels
import SceneModel

/// A vocabulary of visual words for comparing whole photos: VLAD (Jégou et al., "Aggregating local
/// descriptors into a compact image representation", CVPR 2010).
package struct VisualVocabulary: Sendable {
  /// `count × 128` bytes.
  private let words: [UInt8]
  /// Number of words.
  package let count: Int

  /// Learns at most `count` words by k-means from `descriptors`, 128 bytes each.
  package init(
    count: Int, descriptors: [UInt8], iterations: Int = 10, seed: UInt64 = 0,
    _ control: KernelControl
  ) throws {
    let length = FeatureSet.descriptorLength
    self.count = min(count, descriptors.count / length)
    var words = [UInt8](repeating: 0, count: self.count * length)
    if self.count > 0 {
      try withKernel(control) { control in
        ck_learn_words(
          descriptors, descriptors.count / length, words.count / length, Int32(iterations), seed,
          control, &words)
      }
    }
    self.words = words
  }

  /// The VLAD vector of a photo, of unit length; the inner product of two is the photos'
  /// similarity. Zero without features.
  package func vector(of features: FeatureSet, _ control: KernelControl) throws -> [Float] {
    var vector = [Float](repeating: 0, count: words.count)
    guard !vector.isEmpty else { return [] }
    try withKernel(control) { control in
      ck_encode_vlad(features.descriptors, features.count, words, count, control, &vector)
    }
    return vector
  }
}
