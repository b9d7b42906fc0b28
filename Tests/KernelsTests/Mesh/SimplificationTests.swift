import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

@Suite struct SimplificationTests {
  /// Whether every edge belongs to two triangles with opposite directions.
  private func isClosed(_ mesh: Mesh) -> Bool {
    var edges: [SIMD2<UInt32>: Int] = [:]
    for t in mesh.triangles {
      for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] { edges[[a, b], default: 0] += 1 }
    }
    return edges.allSatisfy { edge, count in
      count == 1 && edges[[edge.y, edge.x]] == 1
    }
  }

  /// Meshes of seven subdivisions are simplified in cells. All edges of a sphere cost about the
  /// same: the limit of the costs does not restrain the cells.
  @Test(arguments: [(5, 8000), (5, 1999), (5, 500), (5, 60), (7, 60_000), (7, 8000), (7, 500)])
  func aSphereStaysASphere(subdivisions: Int, budget: Int) throws {
    let mesh = SyntheticMesh.sphere(subdivisions: subdivisions)
    let simple = try mesh.simplified(maximumTriangles: budget, KernelControl())
    #expect(simple.triangles.count <= budget)
    #expect(simple.triangles.count >= budget - 2)
    #expect(isClosed(simple))
    // The sagitta of a patch of area 4π / n, with a margin.
    let tolerance = 6 / Float(budget)
    for position in simple.positions { #expect(abs(position.length - 1) < tolerance) }
    for t in simple.triangles {
      let (a, b, c) = (
        simple.positions[Int(t.a)], simple.positions[Int(t.b)], simple.positions[Int(t.c)]
      )
      #expect((b - a).cross(c - a).dot(a + b + c) > 0)
    }
  }

  @Test func aPlaneKeepsItsBoundary() throws {
    let mesh = SyntheticMesh.grid(cells: 30, origin: .zero, u: [3, 0, 0], v: [0, 2, 0])
    let simple = try mesh.simplified(maximumTriangles: 40, KernelControl())
    #expect(simple.triangles.count <= 40)
    let area = simple.triangles.reduce(Float(0)) { sum, t in
      let a = simple.positions[Int(t.a)]
      return sum
        + (simple.positions[Int(t.b)] - a).cross(simple.positions[Int(t.c)] - a).z / 2
    }
    #expect(abs(area - 6) < 0.01)
    #expect(simple.positions.allSatisfy { abs($0.z) < 1e-5 })
  }

  @Test func duplicateAndDegenerateTrianglesAreRemoved() throws {
    var mesh = SyntheticMesh.cube(cells: 1)
    mesh.triangles += [mesh.triangles[0], .init(0, 0, 1)]
    mesh.positions.append([9, 9, 9])
    let simple = try mesh.simplified(maximumTriangles: 100, KernelControl())
    #expect(simple.triangles.count == 12)
    #expect(simple.positions.count == 8)
    #expect(isClosed(simple))
  }

  @Test func manySmallComponentsMeetTheBudget() throws {
    var mesh = SyntheticMesh.sphere(subdivisions: 3)
    for index in 0..<20 {
      var small = SyntheticMesh.sphere(radius: 0.05, subdivisions: 0)
      small.positions = small.positions.map { $0 + [3 + Float(index), 0, 0] }
      mesh.append(small)
    }
    let simple = try mesh.simplified(maximumTriangles: 50, KernelControl())
    #expect(simple.triangles.count <= 50)
    #expect(simple.positions.contains { abs($0.length - 1) < 0.2 })
  }

  @Test(arguments: [4, 6]) func simplificationIsDeterministic(subdivisions: Int) throws {
    var mesh = SyntheticMesh.sphere(subdivisions: subdivisions)
    mesh.positions = mesh.positions.map { $0 * (1 + 0.05 * sin(11 * $0.x + 7 * $0.y)) }
    let found = try [1, 2, 3, 8].map {
      try mesh.simplified(maximumTriangles: 300, KernelControl(threadCount: $0))
    }
    for other in found.dropFirst() {
      #expect(other.positions == found[0].positions)
      #expect(other.triangles == found[0].triangles)
    }
  }

  /// Where a surface is flat, few triangles are left, although all cells are simplified alike at
  /// first.
  @Test func trianglesAreLeftWhereTheSurfaceIsRough() throws {
    var mesh = SyntheticMesh.grid(cells: 300, origin: .zero, u: [2, 0, 0], v: [0, 1, 0])
    mesh.positions = mesh.positions.map { p in
      p.x < 1 ? p : [p.x, p.y, 0.02 * sin(60 * p.x) * sin(60 * p.y)]
    }
    let simple = try mesh.simplified(
      maximumTriangles: 6000, KernelControl(threadCount: 2))
    let flat = simple.triangles.count { simple.positions[Int($0.a)].x < 0.95 }
    #expect(flat < simple.triangles.count / 20)
  }

  @Test func cancellationStops() {
    let flag = CancellationFlag()
    flag.cancel()
    #expect(throws: CancellationError.self) {
      try SyntheticMesh.sphere(subdivisions: 4)
        .simplified(maximumTriangles: 100, KernelControl(flag: flag))
    }
  }
}
