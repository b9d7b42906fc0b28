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

  /// The indices of the block among elements that take work in proportion to their weights, so that
  /// all blocks have about the same work: those whose middle is in the block's part of the sum.
  package func range(ofWeights weights: [Int]) -> Range<Int> {
    let total = weights.reduce(0, +)
    func bound(_ block: Int) -> Int {
      guard block < count else { return weights.count }
      var before = 0
      return weights.prefix { weight in
        defer { before += weight }
        return (2 * before + weight) * count < 2 * total * block
      }.count
    }
    return bound(index)..<bound(index + 1)
  }
}
