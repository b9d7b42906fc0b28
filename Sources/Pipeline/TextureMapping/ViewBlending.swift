import Kernels
import SceneModel

/// Blends between photos: weights of the photos at the corners, interpolated over the triangles.
///
/// A vertex averages the labels of its triangles; a triangle uses only photos that see it.
struct ViewBlending: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Rings of triangles that the transition covers, beyond those at the label boundary. Chosen.
    var rings = 0
  }

  var options = Options()

  /// `labels` holds the photo chosen for each triangle, −1 for none.
  func run(
    _ rated: RatedViews, labels: [Int32], mesh: Mesh, topology: MeshTopology,
    _ context: StageContext
  ) throws -> CornerWeights {
    try context.control.step(0)
    var vertexShares = mesh.positions.indices.map { vertex in
      merged(topology.triangles(around: vertex).map { .init(view: labels[Int($0)], weight: 1) })
    }
    for ring in 0..<options.rings {
      try context.step(ring + 1, of: options.rings + 1)
      vertexShares = spread(vertexShares, topology)
    }
    var result = CornerWeights()
    result.offsets.reserveCapacity(3 * mesh.triangles.count + 1)
    for (face, triangle) in mesh.triangles.enumerated() {
      for vertex in triangle.vertices {
        result.shares += usable(vertexShares[vertex], face, labels[face], rated)
        result.offsets.append(Int32(result.shares.count))
      }
    }
    return result
  }

  /// Removes the views that the method doesn't use: all but those chosen for the triangle or one
  /// that shares a vertex with it.
  func restrict(
    _ rated: inout RatedViews, labels: [Int32], mesh: Mesh, topology: MeshTopology,
    _ control: KernelControl
  ) throws {
    // With rings, views spread further.
    guard options.rings == 0 else { return }
    try rated.views.updateBlocks(control) { index, block in
      let faces = FaceBlocks.faces(of: index, faceCount: mesh.triangles.count)
      var isUsed = [Bool](repeating: false, count: block.entries.count)
      var used: [Int32] = []
      for (face, triangle) in mesh.triangles[faces].enumerated() {
        used.removeAll(keepingCapacity: true)
        for vertex in triangle.vertices {
          for other in topology.triangles(around: vertex)
          where !used.contains(labels[Int(other)]) {
            used.append(labels[Int(other)])
          }
        }
        for entry in block.range(of: face) {
          isUsed[entry] = used.contains(block.entries[entry].view)
        }
      }
      block.filter { entry, _ in isUsed[entry] }
    }
  }

  /// Averages the shares of each vertex with those of its neighbors.
  private func spread(
    _ shares: [[CornerWeights.Share]], _ topology: MeshTopology
  ) -> [[CornerWeights.Share]] {
    var collected = shares
    for edge in topology.edges {
      let (low, high) = (Int(edge.low), Int(edge.high))
      // Inside one photo's area there is nothing to average.
      if shares[low].count == 1, shares[low].map(\.view) == shares[high].map(\.view) { continue }
      collected[low] += shares[high]
      collected[high] += shares[low]
    }
    return collected.map(merged)
  }

  /// One share per view, ascending, normalized to a sum of 1.
  private func merged(_ shares: [CornerWeights.Share]) -> [CornerWeights.Share] {
    var result: [CornerWeights.Share] = []
    for share in shares.sorted(by: { $0.view < $1.view }) {
      if result.last?.view == share.view {
        result[result.count - 1].weight += share.weight
      } else {
        result.append(share)
      }
    }
    let total = result.reduce(0) { $0 + $1.weight }
    return result.map { .init(view: $0.view, weight: $0.weight / total) }
  }

  /// The shares of views that see the triangle; the triangle's label if there are none.
  private func usable(
    _ shares: [CornerWeights.Share], _ face: Int, _ label: Int32, _ rated: RatedViews
  ) -> [CornerWeights.Share] {
    if label < 0 { return [.init(view: -1, weight: 1)] }
    if shares.count == 1, shares[0].view == label { return shares }
    let seen = shares.filter { $0.view >= 0 && rated.view($0.view, of: face) != nil }
    return seen.isEmpty ? [.init(view: label, weight: 1)] : merged(seen)
  }
}
