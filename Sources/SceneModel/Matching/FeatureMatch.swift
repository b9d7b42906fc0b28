/// A match of feature `first` in the pair's first photo with feature `second` in its second photo.
package struct FeatureMatch: Hashable, Codable, Sendable, BitwiseCopyable {
  package var first: Int32
  package var second: Int32

  package init(first: Int32, second: Int32) {
    self.first = first
    self.second = second
  }
}
