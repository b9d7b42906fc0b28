/// Disjoint sets of numbers (union–find); the lowest number represents its set.
struct DisjointSets: Sendable {
  private var parents: [Int]

  init(count: Int) { parents = Array(0..<count) }

  /// The number that represents the set of `number`.
  mutating func root(_ number: Int) -> Int {
    var number = number
    while parents[number] != number {
      parents[number] = parents[parents[number]]
      number = parents[number]
    }
    return number
  }

  /// Returns false if the two are in the same set already.
  @discardableResult
  mutating func join(_ a: Int, _ b: Int) -> Bool {
    let (a, b) = (root(a), root(b))
    parents[max(a, b)] = min(a, b)
    return a != b
  }

  /// The sets, each ascending, in the order of their lowest numbers.
  mutating func groups() -> [[Int]] {
    var groups = [[Int]](repeating: [], count: parents.count)
    for number in parents.indices { groups[root(number)].append(number) }
    return groups.filter { !$0.isEmpty }
  }
}
