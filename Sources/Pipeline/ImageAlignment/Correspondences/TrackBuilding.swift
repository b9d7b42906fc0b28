import Kernels
import SceneModel

/// Links the matches of pairs into tracks over many photos: union–find that never joins two
/// features of one photo (Moulon and Monasse, "Unordered feature tracking made fast and easy", CVMP
/// 2012).
///
/// Matches that are confirmed by third photos are joined first, so that in a conflict the wrong
/// match is rejected.
package struct TrackBuilding: Sendable {
  package struct Options: Hashable, Codable, Sendable {
    /// Shorter tracks are dropped. Limit: a point needs two observations.
    package var minimumLength = 2

    package init() {}
  }

  package var options: Options

  package init(_ options: Options = Options()) { self.options = options }

  /// Returns the tracks, in order of their first features.
  package func run(
    _ graph: ViewGraph, features: [FeatureSet], _ context: StageContext
  ) throws -> FeatureTracks {
    let nodes = try Nodes(features, context.control.withoutProgress)
    let edges = edges(of: graph, nodes)
    try context.control.step(0.2)
    let supports = try supports(
      of: edges, nodeCount: nodes.count, context.control.withoutProgress)
    try context.control.step(0.5)
    // A stable sort by descending support: buckets keep the order of the pairs.
    var buckets = [[Int]](repeating: [], count: Int(supports.max() ?? 0) + 1)
    for (index, support) in supports.enumerated() { buckets[Int(support)].append(index) }
    var forest = ConsistentForest(photoOfNode: nodes.photos)
    for bucket in buckets.reversed() {
      for index in bucket { forest.join(edges[index].0, edges[index].1) }
    }
    try context.control.step(0.9)
    return tracks(forest, nodes, features)
  }

  private func tracks(
    _ forest: ConsistentForest, _ nodes: Nodes, _ features: [FeatureSet]
  ) -> FeatureTracks {
    var tracks = FeatureTracks(photoCount: features.count)
    for members in forest.components(minimumSize: max(2, options.minimumLength)) {
      tracks.append(
        members.map { node in
          let photo = Int(nodes.photos[Int(node)])
          let feature = Int(node) - nodes.offsets[photo]
          return (
            photo: Int32(photo), feature: Int32(feature),
            pixel: SIMD2<Double>(features[photo].positions[feature])
          )
        })
    }
    return tracks
  }

  /// The matches as pairs of nodes; matches with feature indices out of range are skipped.
  private func edges(of graph: ViewGraph, _ nodes: Nodes) -> [(Int32, Int32)] {
    var edges: [(Int32, Int32)] = []
    for pair in graph.pairs {
      for match in pair.matches {
        guard
          let a = nodes.node(pair.pair.first.index, Int(match.first)),
          let b = nodes.node(pair.pair.second.index, Int(match.second))
        else { continue }
        edges.append((a, b))
      }
    }
    return edges
  }

  /// For each edge, the number of nodes matched with both of its ends.
  private func supports(
    of edges: [(Int32, Int32)], nodeCount: Int, _ control: KernelControl
  ) throws -> [Int32] {
    var offsets = [Int](repeating: 0, count: nodeCount + 1)
    for edge in edges {
      offsets[Int(edge.0) + 1] += 1
      offsets[Int(edge.1) + 1] += 1
    }
    for node in 0..<nodeCount { offsets[node + 1] += offsets[node] }
    var neighbors = [Int32](repeating: 0, count: 2 * edges.count)
    var next = offsets
    for (a, b) in edges {
      neighbors[next[Int(a)]] = b
      next[Int(a)] += 1
      neighbors[next[Int(b)]] = a
      next[Int(b)] += 1
    }
    for node in 0..<nodeCount { neighbors[offsets[node]..<offsets[node + 1]].sort() }
    let unit = 1 << 14  // Edges of a unit of parallel work. Chosen.
    return try control.parallelMap(edges.count, inUnitsOf: unit) {
      [edges, offsets, neighbors] numbers -> [Int32] in
      edges[numbers].map { a, b in
        var (i, j) = (offsets[Int(a)], offsets[Int(b)])
        let (endI, endJ) = (offsets[Int(a) + 1], offsets[Int(b) + 1])
        var common: Int32 = 0
        while i < endI, j < endJ {
          if neighbors[i] == neighbors[j] { common += 1 }
          if neighbors[i] <= neighbors[j] { i += 1 } else { j += 1 }
        }
        return common
      }
    }
  }
}

/// Numbers the features of all photos; features at the same position of a photo share one node.
private struct Nodes {
  var offsets = [0]
  var photos: [Int32] = []
  /// The first feature at the same position as each feature.
  var representatives: [Int32] = []

  var count: Int { photos.count }

  init(_ features: [FeatureSet], _ control: KernelControl) throws {
    let firsts = try control.parallelMap(features.count) {
      Self.firstsAtSamePosition(features[$0].positions)
    }
    for (photo, firsts) in firsts.enumerated() {
      let start = Int32(photos.count)
      photos += repeatElement(Int32(photo), count: firsts.count)
      representatives += firsts.lazy.map { start + $0 }
      offsets.append(photos.count)
    }
  }

  /// For each position, the index of the first equal one.
  private static func firstsAtSamePosition(_ positions: [SIMD2<Float>]) -> [Int32] {
    var known = [SIMD2<Float>: Int32](minimumCapacity: positions.count)
    return positions.enumerated().map { index, position in
      if let first = known[position] { return first }
      known[position] = Int32(index)
      return Int32(index)
    }
  }

  func node(_ photo: Int, _ feature: Int) -> Int32? {
    guard photo >= 0, photo + 1 < offsets.count, feature >= 0 else { return nil }
    let node = offsets[photo] + feature
    return node < offsets[photo + 1] ? representatives[node] : nil
  }
}

/// Union–find whose components hold at most one node per photo.
private struct ConsistentForest {
  private var parents: [Int32]
  /// The nodes of each root's component, sorted by photo; empty for a single node.
  private var members: [[Int32]]
  private let photoOfNode: [Int32]

  init(photoOfNode: [Int32]) {
    self.photoOfNode = photoOfNode
    parents = photoOfNode.indices.map(Int32.init)
    members = Array(repeating: [], count: photoOfNode.count)
  }

  private mutating func root(_ node: Int32) -> Int32 {
    var node = node
    while parents[Int(node)] != node {
      parents[Int(node)] = parents[Int(parents[Int(node)])]
      node = parents[Int(node)]
    }
    return node
  }

  /// Joins the components of two nodes unless they have a photo in common.
  mutating func join(_ a: Int32, _ b: Int32) {
    let (rootA, rootB) = (root(a), root(b))
    guard rootA != rootB else { return }
    let (listA, listB) = (membersOrSelf(rootA), membersOrSelf(rootB))
    var merged: [Int32] = []
    merged.reserveCapacity(listA.count + listB.count)
    var (i, j) = (0, 0)
    while i < listA.count, j < listB.count {
      let (photoA, photoB) = (photoOfNode[Int(listA[i])], photoOfNode[Int(listB[j])])
      if photoA == photoB { return }
      if photoA < photoB {
        merged.append(listA[i])
        i += 1
      } else {
        merged.append(listB[j])
        j += 1
      }
    }
    merged += listA[i...]
    merged += listB[j...]
    let (kept, gone) = listA.count >= listB.count ? (rootA, rootB) : (rootB, rootA)
    parents[Int(gone)] = kept
    members[Int(gone)] = []
    members[Int(kept)] = merged
  }

  private func membersOrSelf(_ root: Int32) -> [Int32] {
    members[Int(root)].isEmpty ? [root] : members[Int(root)]
  }

  /// The nodes of each component of at least `minimumSize`, in order of the components' first
  /// nodes.
  func components(minimumSize: Int) -> [[Int32]] {
    members.filter { $0.count >= minimumSize }.sorted { $0[0] < $1[0] }
  }
}
