import SceneModel

/// Samples points uniformly by area on a mesh; deterministic.
package struct SurfaceSampling: Sendable {
  package init() {}

  /// The positions of `samples`.
  package func run(_ mesh: Mesh, count: Int) -> [SIMD3<Float>] {
    samples(mesh, count: count).map(\.position)
  }

  /// Returns `count` samples: one in each of `count` equal parts of the cumulative area, positioned
  /// in its triangle by a low-discrepancy sequence.
  func samples(_ mesh: Mesh, count: Int) -> [SurfaceSample] {
    let triangles = mesh.triangles.map { FlatTriangle($0, of: mesh) }
    var areas: [Double] = []
    areas.reserveCapacity(triangles.count)
    var total = 0.0
    for triangle in triangles {
      let area = Double(triangle.area)
      total += area.isFinite ? area : 0
      areas.append(total)
    }
    guard total > 0, count > 0 else { return [] }
    var samples: [SurfaceSample] = []
    samples.reserveCapacity(count)
    var index = 0
    // Paper: Roberts 2018, the sequence of the plastic number, a generalization of the golden
    // ratio.
    let steps = SIMD2(0.754_877_666_246_692_7, 0.569_840_290_998_053_2)
    var uv = SIMD2(0.5, 0.5)
    for sample in 0..<count {
      let target = (Double(sample) + 0.5) / Double(count) * total
      while index < areas.count - 1, areas[index] <= target { index += 1 }
      uv += steps
      uv -= uv.rounded(.down)
      let folded = uv.x + uv.y > 1 ? 1 - uv : uv
      let (u, v) = (Float(folded.x), Float(folded.y))
      let t = triangles[index]
      samples.append(
        SurfaceSample(position: t.a + u * (t.b - t.a) + v * (t.c - t.a), normal: t.normal))
    }
    return samples
  }
}
