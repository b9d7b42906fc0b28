/// The strongest chain of links between every two photos: the one whose weakest link is strongest.
///
/// These chains form a maximum spanning forest (Hu, "The maximum capacity route problem",
/// Operations Research 1961). It is built by Kruskal's algorithm, with sets whose paths are not
/// shortened: on the way from a photo to its root, the links become weaker.
struct StrongestChains {
  private var parents: [Int]
  /// The strength of the link that joined a set to its parent's; zero for a root.
  private var strengths: [Int]
  private var sizes: [Int]

  /// `links` have positive strengths.
  init(photoCount: Int, links: [(strength: Int, first: Int, second: Int)]) {
    parents = Array(0..<photoCount)
    strengths = Array(repeating: 0, count: photoCount)
    sizes = Array(repeating: 1, count: photoCount)
    for link in links.sorted(by: { $0.strength > $1.strength }) {
      let (a, b) = (root(link.first), root(link.second))
      guard a != b else { continue }
      let (child, parent) = sizes[a] < sizes[b] ? (a, b) : (b, a)
      parents[child] = parent
      strengths[child] = link.strength
      sizes[parent] += sizes[child]
    }
  }

  private func root(_ photo: Int) -> Int {
    var photo = photo
    while parents[photo] != photo { photo = parents[photo] }
    return photo
  }

  /// The strength of the weakest link of the strongest chain between two different photos; zero if
  /// there is none.
  func weakestLink(between first: Int, and second: Int) -> Int {
    var (a, b) = (first, second)
    var weakest = Int.max
    while a != b {
      if strengths[a] < strengths[b] { swap(&a, &b) }
      guard strengths[a] > 0 else { return 0 }
      weakest = min(weakest, strengths[a])
      a = parents[a]
    }
    return weakest
  }
}
