import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct TextureChartsTests {
  /// Each corner in the plane of its chart.
  private func laidOut(
    _ mesh: Mesh, _ charts: [Int32], _ axes: [SIMD3<Float>]
  ) -> [SIMD2<Float>] {
    mesh.triangles.indices.flatMap { face -> [SIMD2<Float>] in
      let axis = axes[Int(charts[face])]
      let helper: SIMD3<Float> = abs(axis.y) < 0.9 ? [0, 1, 0] : [1, 0, 0]
      let u = helper.cross(axis).normalized
      let v = axis.cross(u)
      let t = mesh.triangles[face]
      return [t.a, t.b, t.c].map { index in
        let p = mesh.positions[Int(index)]
        return [p.dot(u), -p.dot(v)]
      }
    }
  }

  @Test func aCubeHasSixCharts() throws {
    var clustering = ChartClustering()
    clustering.maximumAngle = 0.7
    let mesh = SyntheticMesh.cube(cells: 6)
    let (charts, axes) = try clustering.run(mesh, KernelControl())
    #expect(axes.count == 6)
    for face in mesh.triangles.indices {
      let axis = axes[Int(charts[face])]
      #expect(pointwiseMax(axis, -axis).max() > 0.999)
    }
  }

  @Test func chartsOfASphereRespectTheAngleLimit() throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 4)
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    #expect(axes.count >= 4 && axes.count < 30)
    for (face, t) in mesh.triangles.enumerated() {
      let (a, b, c) = (
        mesh.positions[Int(t.a)], mesh.positions[Int(t.b)], mesh.positions[Int(t.c)]
      )
      #expect((b - a).cross(c - a).normalized.dot(axes[Int(charts[face])]) > 0.15)
    }
  }

  @Test(arguments: [256, 1024]) func packedChartsDoNotOverlap(side: Int) throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 4)
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    let corners = laidOut(mesh, charts, axes)
    let density = [Float](repeating: 1, count: axes.count)
    let packing = ChartPacking(side: side, padding: 2, maximumScale: 1e9)
    let placements = try packing.run(
      corners: corners, charts: charts, density: density, KernelControl())
    let texels = corners.indices.map { placements[Int(charts[$0 / 3])].texel(corners[$0]) }
    #expect(texels.allSatisfy { $0.min() >= 1 && $0.max() <= Float(side) - 1 })
    let canvas = try TextureCanvas(
      RayScene(mesh, KernelControl()), corners: texels, side: side, KernelControl())
    #expect(canvas.overlapCount == 0)
    // Padding has a larger share in a small texture.
    #expect(canvas.usage > (side < 512 ? 0.5 : 0.6))
    for face in mesh.triangles.indices {
      let (a, b, c) = (texels[3 * face], texels[3 * face + 1], texels[3 * face + 2])
      // Counter-clockwise with y up is clockwise with y down.
      #expect((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0)
    }
  }

  @Test func theScaleIsBounded() throws {
    let mesh = SyntheticMesh.cube(cells: 2)
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    let placements = try ChartPacking(side: 1024, padding: 2, maximumScale: 7).run(
      corners: laidOut(mesh, charts, axes), charts: charts,
      density: axes.indices.map { $0 == 0 ? 0.5 : 1 }, KernelControl())
    #expect(placements[0].scale == 3.5)
    #expect(placements.dropFirst().allSatisfy { $0.scale == 7 })
  }

  @Test func overlappingTrianglesGetSeparateCharts() throws {
    // Two and a half turns of a spiral staircase: similar normals, overlapping floors.
    var mesh = Mesh()
    let steps = 60
    for step in 0...steps {
      let angle = Float(step) / 24 * 2 * .pi
      let direction = SIMD3<Float>(cos(angle), 0, sin(angle))
      let height = SIMD3<Float>(0, Float(step) * 0.01, 0)
      mesh.positions += [direction * 0.5 + height, direction + height]
    }
    for step in 0..<UInt32(steps) {
      let i = 2 * step
      mesh.triangles += [.init(i, i + 3, i + 1), .init(i, i + 2, i + 3)]
    }
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    let corners = laidOut(mesh, charts, axes)
    let placements = try ChartPacking(side: 512, padding: 2, maximumScale: 1e9).run(
      corners: corners, charts: charts, density: axes.map { _ in 1 }, KernelControl())
    let texels = corners.indices.map { placements[Int(charts[$0 / 3])].texel(corners[$0]) }
    let canvas = try TextureCanvas(
      RayScene(mesh, KernelControl()), corners: texels, side: 512, KernelControl())
    #expect(canvas.overlapCount < 20)
    #expect(axes.count >= 3)
  }

  /// Unstructured charts: fans of random outline and size, one in eight a thin strip.
  private func randomCharts(
    _ count: Int, seed: UInt64
  ) -> (corners: [SIMD2<Float>], charts: [Int32], density: [Float]) {
    var random = SeededGenerator(seed: seed)
    var result: (corners: [SIMD2<Float>], charts: [Int32], density: [Float]) = ([], [], [])
    for chart in 0..<count {
      let size = Float.random(in: 0.02...1, using: &random)
      let squeeze: SIMD2<Float> = chart % 8 == 0 ? [1, 0.03] : [1, 0.7]
      let boundary = (0..<11).map { step in
        let angle = Float(step) / 11 * 2 * .pi
        return size * Float.random(in: 0.6...1, using: &random) * squeeze
          * SIMD2(cos(angle), sin(angle))
      }
      for step in boundary.indices {
        result.corners += [.zero, boundary[step], boundary[(step + 1) % boundary.count]]
        result.charts.append(Int32(chart))
      }
      result.density.append(Float.random(in: 0.5...2, using: &random))
    }
    return result
  }

  /// The chart that contains each texel's center, or −1; nil if two contain it.
  private func picture(
    of texels: [SIMD2<Float>], charts: [Int32], side: Int
  ) -> [Int32]? {
    var result = [Int32](repeating: -1, count: side * side)
    for face in charts.indices {
      let (a, b, c) = (texels[3 * face], texels[3 * face + 1], texels[3 * face + 2])
      func edge(_ p: SIMD2<Float>, _ q: SIMD2<Float>, _ r: SIMD2<Float>) -> Float {
        (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)
      }
      let low = pointwiseMin(a, pointwiseMin(b, c)), high = pointwiseMax(a, pointwiseMax(b, c))
      let turn: Float = edge(a, b, c) < 0 ? -1 : 1
      for y in max(0, Int(low.y))...min(side - 1, Int(high.y)) {
        for x in max(0, Int(low.x))...min(side - 1, Int(high.x)) {
          let p = SIMD2(Float(x) + 0.5, Float(y) + 0.5)
          guard min(turn * edge(a, b, p), turn * edge(b, c, p), turn * edge(c, a, p)) >= 0 else {
            continue
          }
          let old = result[y * side + x]
          if old >= 0, old != charts[face] { return nil }
          result[y * side + x] = charts[face]
        }
      }
    }
    return result
  }

  @Test(arguments: [(256, 2, 1), (512, 3, 2), (512, 0, 3), (1024, 4, 4)])
  func paddingIsRespected(side: Int, padding: Int, seed: UInt64) throws {
    let (corners, charts, density) = randomCharts(120, seed: seed)
    let packing = ChartPacking(side: side, padding: padding, maximumScale: 1e9)
    let placements = try packing.run(
      corners: corners, charts: charts, density: density, KernelControl())
    let texels = corners.indices.map { placements[Int(charts[$0 / 3])].texel(corners[$0]) }
    let margin = Float((padding + 1) / 2) - 1e-2
    #expect(texels.allSatisfy { $0.min() >= margin && $0.max() <= Float(side) - margin })
    let texelCharts = try #require(picture(of: texels, charts: charts, side: side))
    var closePairs = 0
    for y in 0..<side {
      for x in 0..<side where texelCharts[y * side + x] >= 0 {
        for v in y...min(side - 1, y + padding) {
          for u in max(0, x - padding)...min(side - 1, x + padding) {
            let other = texelCharts[v * side + u]
            if other >= 0, other != texelCharts[y * side + x] { closePairs += 1 }
          }
        }
      }
    }
    #expect(closePairs == 0)
    let usage = Float(texelCharts.count { $0 >= 0 }) / Float(side * side)
    #expect(usage > (side < 512 ? 0.55 : 0.65))
    let again = try packing.run(
      corners: corners, charts: charts, density: density, KernelControl(threadCount: 2))
    #expect(again == placements)
  }

  @Test(arguments: [3, 5]) func chartsAreConnected(subdivisions: Int) throws {
    var mesh = SyntheticMesh.sphere(subdivisions: subdivisions)
    mesh.positions = mesh.positions.map { p in
      (1 + 0.2 * sin(5 * p.x) * sin(7 * p.y) * sin(6 * p.z)) * p
    }
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    var faces = [[Int]](repeating: [], count: mesh.positions.count)
    let vertices = mesh.triangles.map { [Int($0.a), Int($0.b), Int($0.c)] }
    for (face, corners) in vertices.enumerated() {
      for vertex in corners { faces[vertex].append(face) }
    }
    var reached = [Bool](repeating: false, count: charts.count)
    var components = 0
    for start in charts.indices where !reached[start] {
      components += 1
      reached[start] = true
      var open = [start]
      while let face = open.popLast() {
        for other in vertices[face].flatMap({ faces[$0] }) where !reached[other] {
          let shared = vertices[other].count { vertices[face].contains($0) }
          guard shared >= 2, charts[other] == charts[face] else { continue }
          reached[other] = true
          open.append(other)
        }
      }
    }
    #expect(components == axes.count)
    #expect(Set(charts) == Set(axes.indices.map(Int32.init)))
    for (face, t) in mesh.triangles.enumerated() {
      let (a, b, c) = (
        mesh.positions[Int(t.a)], mesh.positions[Int(t.b)], mesh.positions[Int(t.c)]
      )
      #expect((b - a).cross(c - a).normalized.dot(axes[Int(charts[face])]) > 0.35)
    }
    let again = try ChartClustering().run(mesh, KernelControl(threadCount: 2))
    #expect(again.charts == charts && again.axes == axes)
  }

  @Test func aStripOfGrowingTrianglesIsOneChart() throws {
    // Each is cheaper to merge with the previous one than with the next: only the first two agree.
    var mesh = Mesh()
    for step in 0..<3000 {
      let x = Float(step) + 1e-4 * Float(step * step)
      mesh.positions += [[x, 0, 0], [x, 1, 0]]
    }
    for i in stride(from: UInt32(0), to: 5998, by: 2) {
      mesh.triangles += [.init(i, i + 2, i + 1), .init(i + 1, i + 2, i + 3)]
    }
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    #expect(axes.count == 1)
    #expect(charts.allSatisfy { $0 == 0 })
  }

  @Test func cancellationStopsThePacker() throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 3)
    let (charts, axes) = try ChartClustering().run(mesh, KernelControl())
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try ChartPacking(side: 512, padding: 2, maximumScale: 1e9).run(
        corners: laidOut(mesh, charts, axes), charts: charts, density: axes.map { _ in 1 },
        KernelControl(flag: flag))
    }
  }
}
