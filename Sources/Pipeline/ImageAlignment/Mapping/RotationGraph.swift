import Kernels
import SceneModel

/// The relative rotations between pairs of photos.
struct RotationGraph: Sendable {
  var photoCount: Int
  /// Sorted by pair, `first < second`.
  var pairs: [RelativeRotation]

  /// The pairs of each photo: the other photo, in ascending order, and the index of the pair.
  private var neighbors: [[(photo: Int32, pair: Int32)]] {
    var result = [[(photo: Int32, pair: Int32)]](repeating: [], count: photoCount)
    for (index, pair) in pairs.enumerated() {
      result[Int(pair.first)].append((pair.second, Int32(index)))
      result[Int(pair.second)].append((pair.first, Int32(index)))
    }
    for photo in result.indices { result[photo].sort { $0.photo < $1.photo } }
    return result
  }

  // MARK: Triplets

  /// How many triplets there are, and in how many of them the composition of the three rotations
  /// around the triplet is the identity, as it should be (Zach et al., "Disambiguating visual
  /// relations using loop constraints", CVPR 2010).
  struct TripletCounts: Sendable {
    /// Of each pair, in their order.
    var consistent: [Int]
    var total: [Int]

    /// The fraction of all triplets that is consistent; 1 if there is none.
    var consistentShare: Double {
      let all = total.reduce(0, +)
      return all == 0 ? 1 : Double(consistent.reduce(0, +)) / Double(all)
    }
  }

  /// Counts the triplets whose rotations compose to at most `limit` radians.
  func tripletCounts(limit: Double) -> TripletCounts {
    let neighbors = neighbors
    var counts = TripletCounts(consistent: pairs.map { _ in 0 }, total: pairs.map { _ in 0 })
    for (index, pair) in pairs.enumerated() {
      let (a, b) = (neighbors[Int(pair.first)], neighbors[Int(pair.second)])
      var (i, j) = (0, 0)
      while i < a.count, j < b.count {
        // Visits each triplet once, from its two lowest photos.
        if a[i].photo == b[j].photo, a[i].photo > pair.second {
          let (other, third) = (pairs[Int(b[j].pair)], pairs[Int(a[i].pair)])
          let loop = third.rotation.conjugate * other.rotation * pair.rotation
          let isConsistent = loop.angle <= limit ? 1 : 0
          for member in [index, Int(a[i].pair), Int(b[j].pair)] {
            counts.consistent[member] += isConsistent
            counts.total[member] += 1
          }
        }
        if a[i].photo <= b[j].photo { i += 1 } else { j += 1 }
      }
    }
    return counts
  }

  /// The graph without the pairs that are inconsistent in most of their triplets. Pairs that are
  /// part of no triplet are kept.
  func consistent(_ counts: TripletCounts, minimumShare: Double) -> RotationGraph {
    var result = self
    result.pairs = pairs.indices.filter {
      counts.total[$0] == 0
        || (counts.consistent[$0] > 0
          && Double(counts.consistent[$0]) >= minimumShare * Double(counts.total[$0]))
    }.map { pairs[$0] }
    return result
  }

  // MARK: Connectivity

  /// The largest 2-edge-connected component: photos, in ascending order, that stay connected
  /// without any single pair.
  func largestTwoConnectedPart() -> [Int] {
    let bridges = bridges()
    var sets = DisjointSets(count: photoCount)
    for (index, pair) in pairs.enumerated() where !bridges[index] {
      sets.join(Int(pair.first), Int(pair.second))
    }
    return sets.groups().max { ($0.count, $1[0]) < ($1.count, $0[0]) } ?? []
  }

  /// For each pair, whether it is a bridge: the graph becomes disconnected without it (Tarjan,
  /// 1974).
  private func bridges() -> [Bool] {
    let neighbors = neighbors
    var isBridge = pairs.map { _ in false }
    var order = [Int](repeating: -1, count: photoCount)
    var lowest = order
    var clock = 0
    for start in 0..<photoCount where order[start] < 0 {
      var path: [(photo: Int, next: Int, pair: Int)] = [(start, 0, -1)]
      (order[start], lowest[start], clock) = (clock, clock, clock + 1)
      while let top = path.last {
        if top.next < neighbors[top.photo].count {
          path[path.count - 1].next += 1
          let (photo, pair) = neighbors[top.photo][top.next]
          if Int(pair) == top.pair { continue }
          if order[Int(photo)] >= 0 {
            lowest[top.photo] = min(lowest[top.photo], order[Int(photo)])
          } else {
            (order[Int(photo)], lowest[Int(photo)], clock) = (clock, clock, clock + 1)
            path.append((Int(photo), 0, Int(pair)))
          }
        } else {
          path.removeLast()
          guard let parent = path.last else { continue }
          lowest[parent.photo] = min(lowest[parent.photo], lowest[top.photo])
          if lowest[top.photo] > order[parent.photo] { isBridge[top.pair] = true }
        }
      }
    }
    return isBridge
  }

  /// The subgraph of some of the photos, renumbered in their order.
  func restricted(to photos: [Int]) -> RotationGraph {
    var numbers = [Int32](repeating: -1, count: photoCount)
    for (number, photo) in photos.enumerated() { numbers[photo] = Int32(number) }
    return RotationGraph(
      photoCount: photos.count,
      pairs: pairs.compactMap { pair in
        var pair = pair
        (pair.first, pair.second) = (numbers[Int(pair.first)], numbers[Int(pair.second)])
        return pair.first >= 0 && pair.second >= 0 ? pair : nil
      })
  }

  // MARK: Initialization

  /// Rotations along the maximum spanning tree of the pair weights, from photo 0; the identity for
  /// photos that the tree doesn't reach.
  func treeRotations() -> [Quaternion] {
    var sets = DisjointSets(count: photoCount)
    var isInTree = pairs.map { _ in false }
    for index in pairs.indices.sorted(by: { (-pairs[$0].weight, $0) < (-pairs[$1].weight, $1) }) {
      isInTree[index] = sets.join(Int(pairs[index].first), Int(pairs[index].second))
    }
    let neighbors = neighbors
    var rotations = [Quaternion?](repeating: nil, count: photoCount)
    var reached = photoCount > 0 ? [0] : []
    if photoCount > 0 { rotations[0] = .identity }
    while let photo = reached.popLast() {
      guard let own = rotations[photo] else { continue }
      for (other, index) in neighbors[photo] where isInTree[Int(index)] {
        guard rotations[Int(other)] == nil else { continue }
        let pair = pairs[Int(index)]
        let step = Int(pair.first) == photo ? pair.rotation : pair.rotation.conjugate
        rotations[Int(other)] = (step * own).normalized
        reached.append(Int(other))
      }
    }
    return rotations.map { $0 ?? .identity }
  }
}
