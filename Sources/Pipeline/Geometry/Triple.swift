/// Three values: an array of fixed size, which takes no allocation.
struct Triple<Element: Sendable>: RandomAccessCollection, Sendable {
  private let (first, second, third): (Element, Element, Element)

  init(_ first: Element, _ second: Element, _ third: Element) {
    (self.first, self.second, self.third) = (first, second, third)
  }

  var startIndex: Int { 0 }
  var endIndex: Int { 3 }

  subscript(index: Int) -> Element {
    switch index {
    case 0: first
    case 1: second
    default: third
    }
  }
}
