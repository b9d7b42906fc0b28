/// The photos that are not joined with the rest, in groups that match each other.
struct MatchGaps {
  /// Two photos on both sides of a gap.
  struct Link {
    /// In the group, and in the rest.
    var first: Int
    var second: Int
    var matches: Int
  }

  let names: [String]
  /// Larger groups first; photos that are blurred, which is reason enough, belong to none.
  let groups: [[Int]]
  /// The photos that were aligned, or without alignment those of the largest group.
  private let main: Set<Int>
  private let pairs: MatchRecord

  /// Nil before matching, or if nothing is joined.
  init?(_ report: RunReport, minimumSharpness: Double) {
    guard let matches = report.matches else { return nil }
    let entries = Dictionary(
      report.photos.map { ($0.name, $0) }, uniquingKeysWith: { first, _ in first })
    names = matches.photos
    pairs = matches.pairs
    let aligned = names.indices.filter { entries[matches.photos[$0]]?.status == .registered }
    main = Set(aligned.isEmpty ? pairs.groups.first { $0.count > 1 } ?? [] : aligned)
    guard !main.isEmpty else { return nil }
    var sets = DisjointSets(count: names.count)
    for row in pairs.first.indices where pairs.needed[row] == 0 {
      let (a, b) = (pairs.first[row], pairs.second[row])
      if !main.contains(a), !main.contains(b) { sets.join(a, b) }
    }
    let main = main
    groups = sets.groups().map { group in
      group.filter {
        !main.contains($0) && (entries[matches.photos[$0]]?.sharpness ?? 1) >= minimumSharpness
      }
    }
    .filter { !$0.isEmpty }
    .sorted { ($1.count, $0[0]) < ($0.count, $1[0]) }
  }

  /// The pair with the most matches between a group and the rest; nil if no pair was compared.
  func link(_ group: [Int]) -> Link? {
    let group = Set(group)
    let links = pairs.first.indices.compactMap { row -> Link? in
      let (a, b, matches) = (pairs.first[row], pairs.second[row], pairs.matches[row])
      if group.contains(a), main.contains(b) { return Link(first: a, second: b, matches: matches) }
      if group.contains(b), main.contains(a) { return Link(first: b, second: a, matches: matches) }
      return nil
    }
    return links.max { ($0.matches, $1.first, $1.second) < ($1.matches, $0.first, $0.second) }
  }

  /// The photos of the rest and of a group that are closest to each other in the order of the
  /// files, which is mostly that of the capture.
  func neighbors(of group: [Int]) -> [Int] {
    let pairs = group.flatMap { a in main.sorted().map { (a, $0) } }
    let best = pairs.min { abs($0.0 - $0.1) < abs($1.0 - $1.1) } ?? (0, 0)
    return [best.1, best.0]
  }
}
