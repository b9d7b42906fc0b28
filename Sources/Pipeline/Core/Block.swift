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

  /// The indices of the block among elements that take work in proportion to their weights. Each
  /// element, the heaviest first, is in the block that has the least work by then (Graham, "Bounds
  /// on multiprocessing timing anomalies", SIAM J. Appl. Math. 1969). The first blocks have the
  /// most work, so that processes that take one block after the other end at about the same time.
  package func indices(ofWeights weights: [Int]) -> [Int] {
    typealias Part = (work: Int, number: Int, elements: [Int])
    var parts = Heap<Part> { ($0.work, $0.number) < ($1.work, $1.number) }
    for number in 0..<count { parts.insert((0, number, [])) }
    for element in weights.indices.sorted(by: { (-weights[$0], $0) < (-weights[$1], $1) }) {
      guard var part = parts.popFirst() else { break }
      part.work += weights[element]
      part.elements.append(element)
      parts.insert(part)
    }
    let all = (0..<count).compactMap { _ in parts.popFirst() }
    return all[count - 1 - index].elements.sorted()
  }
}
