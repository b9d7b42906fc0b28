/// Distinct values, numbered in order of their first appearance.
struct CrateTable<Element: Hashable> {
  private(set) var elements: [Element] = []
  private var indices: [Element: UInt32] = [:]

  mutating func index(_ element: Element) -> UInt32 {
    if let index = indices[element] { return index }
    let index = UInt32(elements.count)
    elements.append(element)
    indices[element] = index
    return index
  }
}
