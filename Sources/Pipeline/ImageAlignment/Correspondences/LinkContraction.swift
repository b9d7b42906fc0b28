import Kernels
import SceneModel

/// Greedy edge contraction of a graph of photos: the link of the highest weight is contracted until
/// none is positive; parallel links add up.
///
/// Links wait in a heap, in which those that have changed since are skipped, and the smaller of two
/// adjacency lists is merged into the larger one: O(n log² n) for n links.
struct LinkContraction {
  typealias Link = PlacementLink

  private struct Entry {
    var weight: Int
    var first: Int
    var second: Int
  }

  /// The links of each remaining node, by the node at the other end.
  private var links: [[Int: Link]]
  private var sets: DisjointSets

  init(_ links: [PhotoPair: Link], photoCount: Int) {
    self.links = Array(repeating: [:], count: photoCount)
    sets = DisjointSets(count: photoCount)
    for (pair, link) in links {
      self.links[pair.first.index][pair.second.index] = link
      self.links[pair.second.index][pair.first.index] = link
    }
  }

  /// The groups of contracted photos, each in ascending order.
  var groups: [[Int]] {
    var sets = sets
    return sets.groups()
  }

  /// Contracts all links whose weight is positive.
  mutating func run(_ control: KernelControl, weight: (Link) -> Int) throws {
    // The highest weight first; ties by the nodes, so that the order of hashing has no effect.
    var heap = Heap<Entry> {
      ($0.weight, $1.first, $1.second) > ($1.weight, $0.first, $0.second)
    }
    func push(_ a: Int, _ b: Int, _ link: Link) {
      let weight = weight(link)
      if weight > 0 { heap.insert(Entry(weight: weight, first: min(a, b), second: max(a, b))) }
    }
    for node in links.indices {
      for (other, link) in links[node] where node < other { push(node, other, link) }
    }
    while let best = heap.popFirst() {
      try control.checkCancellation()
      guard let link = links[best.first][best.second], weight(link) == best.weight else {
        continue
      }
      let (kept, gone) =
        links[best.first].count >= links[best.second].count
        ? (best.first, best.second) : (best.second, best.first)
      sets.join(kept, gone)
      links[kept][gone] = nil
      for (other, link) in links[gone] where other != kept {
        links[other][gone] = nil
        var sum = links[kept][other] ?? Link()
        sum += link
        links[kept][other] = sum
        links[other][kept] = sum
        push(kept, other, sum)
      }
      links[gone] = [:]
    }
  }
}
