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

  @Test func chartsOfASphereLieFlatWithinTheAngle() throws {
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
    // The padding weighs more in a small texture.
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

  @Test func trianglesThatWouldLieOnOthersGetTheirOwnChart() throws {
    // Two and a half turns of a spiral staircase: all normals alike, floors above each other.
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

  @Test func cancelStopsThePacker() throws {
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
