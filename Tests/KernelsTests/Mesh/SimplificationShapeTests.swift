import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// Properties of a surface that simplification must preserve.
@Suite struct SimplificationShapeTests {
  @Test(arguments: [24, 60, 300]) func aBoxKeepsItsCreases(budget: Int) throws {
    let simple = try SyntheticMesh.cube(cells: 40)
      .simplified(maximumTriangles: budget, KernelControl())
    #expect(simple.triangles.count <= budget)
    for x in [Float(-1), 1] {
      for y in [Float(-1), 1] {
        for z in [Float(-1), 1] {
          #expect(simple.positions.contains { ($0 - [x, y, z]).length < 1e-3 })
        }
      }
    }
    // A triangle across a crease would have its center inside the box.
    for point in simple.positions + simple.triangles.map({ middle(of: $0, in: simple) }) {
      #expect(abs(max(abs(point.x), abs(point.y), abs(point.z)) - 1) < 1e-3)
    }
  }

  /// Tangent planes of a sphere would change its volume by 4.8 / n; the fit leaves a fifth of that.
  @Test(arguments: [1999, 500, 60]) func aSphereKeepsItsVolume(budget: Int) throws {
    let mesh = SyntheticMesh.sphere(subdivisions: 5)
    let simple = try mesh.simplified(maximumTriangles: budget, KernelControl())
    #expect(abs(simple.volume / mesh.volume - 1) < 1.25 / Double(budget))
  }

  @Test(arguments: [600, 200]) func aTubeKeepsItsBoundary(budget: Int) throws {
    let mesh = tube(segments: 160, rings: 80)
    let simple = try mesh.simplified(maximumTriangles: budget, KernelControl())
    #expect(simple.triangles.count <= budget)
    let edges = edgeCounts(of: simple)
    let boundary = edges.filter { $0.value == 1 }.keys
    #expect(edges.values.allSatisfy { $0 <= 2 })
    for sign in [Float(-1), 1] {
      let ends = boundary.filter { simple.positions[Int($0.x)].y * sign > 0 }
      #expect(ends.count >= 16)
      // A closed polygon has as many corners as sides.
      #expect(Set(ends.flatMap { [$0.x, $0.y] }).count == ends.count)
      for end in ends {
        #expect(abs(simple.positions[Int(end.x)].y - 1.5 * sign) < 1e-3)
        #expect(abs(simple.positions[Int(end.y)].y - 1.5 * sign) < 1e-3)
      }
    }
    // The corners are less far outside than the sides of a polygon of 16 are inside.
    let sagitta = 1 - cos(Float.pi / 16)
    for position in simple.positions {
      #expect(abs(SIMD3(position.x, 0, position.z).length - 1) < sagitta / 2)
    }
  }

  /// A torus with ripples and noise, which an error limit alone would fold.
  @Test(arguments: [2000, 300]) func aTorusStaysATorus(budget: Int) throws {
    let simple = try torus(segments: 96, rings: 48)
      .simplified(maximumTriangles: budget, KernelControl())
    #expect(simple.triangles.count <= budget)
    #expect(simple.triangles.count >= budget - 2)
    let edges = edgeCounts(of: simple)
    #expect(edges.values.allSatisfy { $0 == 2 })
    #expect(simple.positions.count + simple.triangles.count == edges.count)
    #expect(isManifoldAtVertices(simple))
    for triangle in simple.triangles {
      let center = middle(of: triangle, in: simple)
      let ring = SIMD3(center.x, 0, center.z).normalized
      #expect(normal(of: triangle, in: simple).dot(center - ring) > 0)
    }
  }

  @Test func surfacesSharingAnEdgeStayConnected() throws {
    var mesh = Mesh()
    for u in [SIMD3<Float>(1, 0, 0), [-1, 0, 0.5], [0, 0, -1]] {
      mesh.append(SyntheticMesh.grid(cells: 12, origin: .zero, u: u, v: [0, 1, 0]))
    }
    let simple = try SyntheticMesh.welded(mesh)
      .simplified(maximumTriangles: 150, KernelControl())
    #expect(simple.triangles.count <= 150)
    let shared = edgeCounts(of: simple).filter { $0.value == 3 }.keys
    var length: Float = 0
    for edge in shared {
      let (a, b) = (simple.positions[Int(edge.x)], simple.positions[Int(edge.y)])
      length += (b - a).length
      for end in [a, b] { #expect(SIMD3(end.x, 0, end.z).length < 1e-3) }
    }
    #expect(abs(length - 1) < 1e-3)
  }

  @Test func resultIsScaleInvariant() throws {
    let mesh = torus(segments: 64, rings: 32)
    var large = mesh
    large.positions = mesh.positions.map { $0 * 1024 }
    let simple = try mesh.simplified(maximumTriangles: 500, KernelControl())
    let simpleLarge = try large.simplified(maximumTriangles: 500, KernelControl())
    #expect(simple.triangles == simpleLarge.triangles)
    #expect(simple.positions.map { $0 * 1024 } == simpleLarge.positions)
  }

  // MARK: - Shapes

  /// An open tube around the y axis: radius 1, length 3.
  private func tube(segments: Int, rings: Int) -> Mesh {
    var mesh = Mesh()
    for ring in 0...rings {
      for segment in 0..<segments {
        let angle = 2 * Float.pi * (Float(segment) + Float(ring % 2) / 2) / Float(segments)
        mesh.positions.append([cos(angle), 3 * Float(ring) / Float(rings) - 1.5, -sin(angle)])
      }
    }
    for ring in 0..<rings {
      addBand(from: ring * segments, to: (ring + 1) * segments, segments: segments, &mesh)
    }
    return mesh
  }

  /// Around the y axis: a circle of radius 1 with a rippled, noisy tube of radius 0.4.
  private func torus(segments: Int, rings: Int) -> Mesh {
    var mesh = Mesh()
    var random = SplitMix64(seed: 3)
    for ring in 0..<rings {
      for segment in 0..<segments {
        let around = 2 * Float.pi * Float(segment) / Float(segments)
        let up = 2 * Float.pi * Float(ring) / Float(rings)
        let radius =
          0.4 + 0.02 * sin(6 * around) * sin(4 * up)
          + Float.random(in: -0.004...0.004, using: &random)
        let out = 1 + radius * cos(up)
        mesh.positions.append([out * cos(around), radius * sin(up), -out * sin(around)])
      }
    }
    for ring in 0..<rings {
      addBand(
        from: ring * segments, to: (ring + 1) % rings * segments, segments: segments, &mesh)
    }
    return mesh
  }

  /// Joins two closed rows of vertices.
  private func addBand(from lower: Int, to upper: Int, segments: Int, _ mesh: inout Mesh) {
    for segment in 0..<segments {
      let next = (segment + 1) % segments
      let (a, b) = (UInt32(lower + segment), UInt32(lower + next))
      let (c, d) = (UInt32(upper + segment), UInt32(upper + next))
      mesh.triangles += [.init(a, b, d), .init(a, d, c)]
    }
  }

  // MARK: - Measures

  private func middle(of triangle: Triangle, in mesh: Mesh) -> SIMD3<Float> {
    (mesh.positions[Int(triangle.a)] + mesh.positions[Int(triangle.b)]
      + mesh.positions[Int(triangle.c)]) / 3
  }

  private func normal(of triangle: Triangle, in mesh: Mesh) -> SIMD3<Float> {
    let a = mesh.positions[Int(triangle.a)]
    return (mesh.positions[Int(triangle.b)] - a).cross(mesh.positions[Int(triangle.c)] - a)
  }

  /// The number of triangles at each edge; the smaller index first.
  private func edgeCounts(of mesh: Mesh) -> [SIMD2<UInt32>: Int] {
    var counts: [SIMD2<UInt32>: Int] = [:]
    for t in mesh.triangles {
      for (a, b) in [(t.a, t.b), (t.b, t.c), (t.c, t.a)] {
        counts[[min(a, b), max(a, b)], default: 0] += 1
      }
    }
    return counts
  }

  /// Whether the triangles at each vertex of a closed surface form a single fan.
  private func isManifoldAtVertices(_ mesh: Mesh) -> Bool {
    var next = [[UInt32: UInt32]](repeating: [:], count: mesh.positions.count)
    for t in mesh.triangles {
      for (v, a, b) in [(t.a, t.b, t.c), (t.b, t.c, t.a), (t.c, t.a, t.b)] {
        next[Int(v)][a] = b
      }
    }
    return next.allSatisfy { ring in
      guard let first = ring.keys.first else { return false }
      var (count, current) = (1, ring[first])
      while let vertex = current, vertex != first, count <= ring.count {
        (count, current) = (count + 1, ring[vertex])
      }
      return current == first && count == ring.count
    }
  }
}
