/// One of several parts of a sequence of the same length: what one of several processes makes.
package struct Block: Hashable, Sendable {
  package var index: Int
  package var count: Int

  /// `index` is in 0..<`count`.
  package init(index: Int, of count: Int) {
    self.index = index
    self.count = count
  }

  /// The indices of the block among `total` elements.
  package func range(of total: Int) -> Range<Int> {
    (index * total / count)..<((index + 1) * total / count)
  }
}
