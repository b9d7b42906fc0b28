import Foundation
import SceneModel

/// Merges pairs of triangles into quads: first the pairs closest to flat squares, then as many as
/// can still be matched (the matching of Remacle et al., "Blossom-Quad", 2012, solved greedily).
/// Triangles without a partner stay, and no quad crosses a texture seam.
struct QuadPairing: Sendable {
  struct Options: Hashable, Codable, Sendable {
    /// Maximum angle between the normals of the two triangles, in degrees. Chosen.
    var maximumBendDegrees: Float = 40
    /// Maximum deviation of a corner from a right angle, in degrees. Chosen.
    var maximumSkewDegrees: Float = 75
    /// Rounds of augmentation, which split a pair to form two others. Chosen.
    var rounds = 8
  }

  var options = Options()

  /// The same model with each texture's triangles reordered: those of quads first, in pairs.
  func run(_ model: TexturedMesh, _ context: StageContext) throws -> TexturedMesh {
    guard !model.atlases.isEmpty, model.textureTriangles.count == model.mesh.triangles.count else {
      return model
    }
    try context.control.step(0)
    let graph = PairGraph(pairs(in: model), triangleCount: model.mesh.triangles.count)
    let partners = graph.matching(rounds: options.rounds)
    try context.control.step(1)
    let result = reordered(model, partners: partners)
    let quads = result.atlases.map(\.quadCount).reduce(0, +)
    context.notes.record("quads", Double(quads))
    context.notes.record("polygons", Double(model.mesh.triangles.count - quads))
    return result
  }

  /// The candidate pairs, best first.
  private func pairs(in model: TexturedMesh) -> [PairGraph.Pair] {
    let atlas = model.atlases.enumerated().flatMap { index, atlas in
      repeatElement(Int32(index), count: atlas.triangles.count)
    }
    let edges = MeshTopology(model.mesh).edges
    let rated = edges.compactMap { edge -> PairGraph.Pair? in
      guard edge.second >= 0, atlas[Int(edge.first)] == atlas[Int(edge.second)],
        let quad = Quad(Int(edge.first), Int(edge.second), of: model),
        let quality = quality(of: quad, in: model.mesh)
      else { return nil }
      return PairGraph.Pair(first: edge.first, second: edge.second, quality: quality)
    }
    return rated.enumerated()
      .sorted { ($0.element.quality, $1.offset) > ($1.element.quality, $0.offset) }
      .map(\.element)
  }

  /// 0…1, where 1 is a flat rectangle; nil if bent, skewed or not convex.
  private func quality(of quad: Quad, in mesh: Mesh) -> Float? {
    let p = quad.corners.map { mesh.positions[Int($0)] }
    let normals = [(p[1] - p[0]).cross(p[2] - p[0]), (p[2] - p[0]).cross(p[3] - p[0])]
    let bend = Mesh.angle(normals[0], normals[1])
    guard bend <= options.maximumBendDegrees * .pi / 180 else { return nil }
    let skew =
      (0..<4).map { corner -> Float in
        let (next, last) = (p[(corner + 1) % 4] - p[corner], p[(corner + 3) % 4] - p[corner])
        let angle = Mesh.angle(next, last)
        let isConvex = next.cross(last).dot(normals[0] + normals[1]) > 0
        return isConvex ? abs(angle - .pi / 2) : .infinity
      }.max() ?? .infinity
    guard skew <= options.maximumSkewDegrees * .pi / 180 else { return nil }
    return cos(bend) * (1 - skew / (.pi / 2))
  }

  /// Moves the triangles of quads to the front of their atlas.
  private func reordered(_ model: TexturedMesh, partners: [Int32]) -> TexturedMesh {
    var result = model
    for (index, atlas) in model.atlases.enumerated() {
      var next = atlas.triangles.lowerBound
      func put(_ triangle: Triangle, _ texture: Triangle) {
        result.mesh.triangles[next] = triangle
        result.textureTriangles[next] = texture
        next += 1
      }
      for face in atlas.triangles where Int(partners[face]) > face {
        guard let quad = Quad(face, Int(partners[face]), of: model) else { continue }
        put(quad.triangles.0, quad.textureTriangles.0)
        put(quad.triangles.1, quad.textureTriangles.1)
      }
      result.atlases[index].quadCount = (next - atlas.triangles.lowerBound) / 2
      for face in atlas.triangles where partners[face] < 0 {
        put(model.mesh.triangles[face], model.textureTriangles[face])
      }
    }
    return result
  }
}

/// A quad a, b, c, d made of the triangles (a, b, c) and (a, c, d).
private struct Quad {
  let corners: [UInt32]
  let texels: [UInt32]

  /// Nil if the triangles share no edge in the mesh or in the texture, or are oppositely oriented.
  init?(_ first: Int, _ second: Int, of model: TexturedMesh) {
    let (v, w) = (
      Self.corners(model.mesh.triangles[first]), Self.corners(model.mesh.triangles[second])
    )
    let t = Self.corners(model.textureTriangles[first])
    let u = Self.corners(model.textureTriangles[second])
    guard let (i, j) = Self.sharedEdge(v, w),
      t[i] == u[(j + 1) % 3], t[(i + 1) % 3] == u[j]
    else { return nil }
    // d is the opposite corner.
    corners = [v[(i + 1) % 3], v[(i + 2) % 3], v[i], w[(j + 2) % 3]]
    texels = [t[(i + 1) % 3], t[(i + 2) % 3], t[i], u[(j + 2) % 3]]
  }

  /// The edge of two triangles that runs from v[i] to v[i + 1], and from w[j] to w[j + 1] in the
  /// other direction.
  private static func sharedEdge(_ v: [UInt32], _ w: [UInt32]) -> (i: Int, j: Int)? {
    for i in 0..<3 {
      if let j = (0..<3).first(where: { v[i] == w[($0 + 1) % 3] && v[(i + 1) % 3] == w[$0] }) {
        return (i, j)
      }
    }
    return nil
  }

  var triangles: (Triangle, Triangle) { Self.halves(corners) }
  var textureTriangles: (Triangle, Triangle) { Self.halves(texels) }

  private static func halves(_ c: [UInt32]) -> (Triangle, Triangle) {
    (Triangle(c[0], c[1], c[2]), Triangle(c[0], c[2], c[3]))
  }

  private static func corners(_ t: Triangle) -> [UInt32] { [t.a, t.b, t.c] }
}

/// Triangles and the neighbors that they could form a quad with.
private struct PairGraph {
  struct Pair {
    var first: Int32
    var second: Int32
    var quality: Float
  }

  private let pairs: [Pair]
  /// The possible partners of each triangle, best first.
  private var neighbors: [[Int32]]

  /// `pairs` are sorted by priority.
  init(_ pairs: [Pair], triangleCount: Int) {
    self.pairs = pairs
    neighbors = [[Int32]](repeating: [], count: triangleCount)
    for pair in pairs {
      neighbors[Int(pair.first)].append(pair.second)
      neighbors[Int(pair.second)].append(pair.first)
    }
  }

  /// The partner of each triangle, −1 for none.
  func matching(rounds: Int) -> [Int32] {
    var partners = [Int32](repeating: -1, count: neighbors.count)
    for pair in pairs where partners[Int(pair.first)] < 0 && partners[Int(pair.second)] < 0 {
      partners[Int(pair.first)] = pair.second
      partners[Int(pair.second)] = pair.first
    }
    for _ in 0..<rounds {
      guard augment(&partners) else { break }
    }
    return partners
  }

  /// Augments the matching: splits a pair whose members both have an unmatched neighbor into two
  /// pairs. Returns whether any pair changed.
  private func augment(_ partners: inout [Int32]) -> Bool {
    var hasChanged = false
    for unmatched in neighbors.indices where partners[unmatched] < 0 {
      for near in neighbors[unmatched] {
        let far = partners[Int(near)]
        guard far >= 0,
          let other = neighbors[Int(far)].first(where: {
            partners[Int($0)] < 0 && Int($0) != unmatched
          })
        else { continue }
        (partners[unmatched], partners[Int(near)]) = (near, Int32(unmatched))
        (partners[Int(far)], partners[Int(other)]) = (other, far)
        hasChanged = true
        break
      }
    }
    return hasChanged
  }
}
