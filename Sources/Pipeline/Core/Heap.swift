/// A binary heap: a queue from which the first element by an order is taken.
struct Heap<Element> {
  private var elements: [Element] = []
  private let isBefore: (Element, Element) -> Bool

  /// `isBefore` must be a strict weak order; a total one makes the order of equal elements known.
  init(_ isBefore: @escaping (Element, Element) -> Bool) { self.isBefore = isBefore }

  /// Adds an element in O(log n).
  mutating func insert(_ element: Element) {
    elements.append(element)
    var child = elements.count - 1
    while child > 0, isBefore(elements[child], elements[(child - 1) / 2]) {
      elements.swapAt(child, (child - 1) / 2)
      child = (child - 1) / 2
    }
  }

  /// Removes the first element in O(log n); nil if there is none.
  mutating func popFirst() -> Element? {
    guard !elements.isEmpty else { return nil }
    elements.swapAt(0, elements.count - 1)
    let first = elements.removeLast()
    var parent = 0
    while let child = firstChild(of: parent), isBefore(elements[child], elements[parent]) {
      elements.swapAt(child, parent)
      parent = child
    }
    return first
  }

  /// The child of a node that comes first; nil if it has none.
  private func firstChild(of parent: Int) -> Int? {
    let (left, right) = (2 * parent + 1, 2 * parent + 2)
    guard left < elements.count else { return nil }
    return right < elements.count && isBefore(elements[right], elements[left]) ? right : left
  }
}
