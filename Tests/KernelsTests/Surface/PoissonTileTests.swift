import Foundation
import Kernels
import SceneModel
import TestSupport
import Testing

/// A surface that is solved in parts.
@Suite struct PoissonTileTests {
  private static let (baseDepth, depth) = (6, 9)
  /// Cells of the boxes' level by which the samples of a part reach beyond its box.
  private static let margin = 6

  private let points: [SIMD3<Float>]
  private let normals: [SIMD3<Float>]
  private let base: PoissonSolution

  /// A bumpy sphere of radius 1 with 200,000 samples; each tenth is in the base.
  init() throws {
    let count = 200_000
    let bump = { (p: SIMD3<Float>) in 1 + 0.03 * sin(9 * p.x) * sin(9 * p.y) * sin(9 * p.z) }
    let directions = (0..<count).map { index -> SIMD3<Float> in
      let z = 1 - 2 * (Float(index) + 0.5) / Float(count)
      let (radius, angle) = ((1 - z * z).squareRoot(), 2.399_963 * Float(index))
      return [radius * cos(angle), radius * sin(angle), z]
    }
    let points = directions.map { bump($0) * $0 }
    let normals = directions.map { direction in
      // From two tangents, by differences.
      let axis: SIMD3<Float> = abs(direction.x) < 0.7 ? [1, 0, 0] : [0, 1, 0]
      let first = direction.cross(axis).normalized
      let second = direction.cross(first).normalized
      let moved = [first, second].map { tangent -> SIMD3<Float> in
        let (a, b) = (
          (direction + 0.001 * tangent).normalized, (direction - 0.001 * tangent).normalized
        )
        return bump(a) * a - bump(b) * b
      }
      return moved[0].cross(moved[1]).normalized
    }
    (self.points, self.normals) = (points, normals)
    var solver = PoissonReconstruction()
    solver.depth = Self.baseDepth
    let thinned = stride(from: 0, to: count, by: 10)
    base = try solver.solve(
      positions: thinned.map { points[$0] }, normals: thinned.map { normals[$0] },
      in: Cube(origin: [-1.2, -1.2, -1.2], side: 2.4), KernelControl())
  }

  /// Boxes of cells of the base's level that fill the cube.
  private static let boxes: [CellBox] = [
    CellBox(depth: baseDepth, low: [0, 0, 0], high: [27, 64, 64]),
    CellBox(depth: baseDepth, low: [27, 0, 0], high: [64, 40, 64]),
    CellBox(depth: baseDepth, low: [27, 40, 0], high: [64, 64, 33]),
    CellBox(depth: baseDepth, low: [27, 40, 33], high: [64, 64, 64]),
  ]

  private func isInside(_ point: SIMD3<Float>, _ box: CellBox) -> Bool {
    let cell = (SIMD3<Double>(point) - base.cube.origin) / base.cube.side * exp2(Double(box.depth))
    return (0..<3).allSatisfy { cell[$0] >= Double(box.low[$0]) && cell[$0] < Double(box.high[$0]) }
  }

  private func part(_ box: CellBox, threads: Int = 2) throws -> PoissonSolution {
    let reach = box.dilated(by: Self.margin)
    let indices = points.indices.filter { isInside(points[$0], reach) }
    return try base.refined(
      positions: indices.map { points[$0] }, normals: indices.map { normals[$0] },
      depth: Self.depth, KernelControl(threadCount: threads))
  }

  /// The surfaces of all boxes, each from its own part with the values of the others around it.
  private func surfaces() throws -> [Mesh] {
    let parts = try Self.boxes.map { try part($0) }
    let bytes = try zip(parts, Self.boxes).map { try $0.encoded(for: $1) }
    return try Self.boxes.indices.map { index in
      let reach = Self.boxes[index].dilated(by: 1)
      for other in Self.boxes.indices where other != index {
        let neighbor = try bytes[other].withUnsafeBytes {
          try PoissonSolution(encoded: $0, for: reach, KernelControl())
        }
        try parts[index].adopt(
          neighbor, below: Self.baseDepth, in: Self.boxes[other], KernelControl())
      }
      return try parts[index].surface(in: Self.boxes[index], KernelControl())
    }
  }

  /// The edges that triangles pass in one direction only, if vertices at exactly the same position
  /// are one.
  private func openEdges(_ meshes: [Mesh]) -> Int {
    var uses: [[SIMD3<Float>]: Int] = [:]
    for mesh in meshes {
      for t in mesh.triangles {
        let corners = [t.a, t.b, t.c].map { mesh.positions[Int($0)] }
        for (start, end) in zip(corners, corners.dropFirst() + corners.prefix(1)) {
          uses[[start, end], default: 0] += 1
          uses[[end, start], default: 0] -= 1
        }
      }
    }
    return uses.values.count { $0 != 0 }
  }

  @Test func surfacesOfPartsFitTogetherToTheLastBit() throws {
    let surfaces = try surfaces()
    #expect(surfaces.allSatisfy { $0.triangles.count > 5000 })
    #expect(openEdges(surfaces) == 0)
  }

  @Test func partsAreAsGoodAsTheWhole() throws {
    var solver = PoissonReconstruction()
    solver.depth = Self.depth
    let whole = try solver.solve(
      positions: points, normals: normals, in: base.cube, KernelControl(threadCount: 2)
    ).surface(KernelControl())
    let cell = Float(base.cube.side) / Float(1 << Self.depth)
    let surfaces = try surfaces()
    let count = surfaces.reduce(0) { $0 + $1.triangles.count }
    #expect(abs(count - whole.triangles.count) < whole.triangles.count / 50)
    for surface in surfaces {
      let nearest = try NearestPoints(of: surface.positions, in: points, KernelControl())
      let errors = zip(surface.positions, nearest.indices).map { position, index in
        abs((position - points[Int(index)]).dot(normals[Int(index)])) / cell
      }
      #expect(errors.reduce(0, +) / Float(errors.count) < 0.05)
      #expect(errors.max() ?? 1 < 0.5)
    }
  }

  @Test func encodingKeepsTheSurface() throws {
    let box = Self.boxes[2]
    let part = try part(box)
    let bytes = try part.encoded(for: box)
    let restored = try bytes.withUnsafeBytes {
      try PoissonSolution(encoded: $0, for: box, KernelControl())
    }
    let (one, other) = (
      try part.surface(in: box, KernelControl()), try restored.surface(in: box, KernelControl())
    )
    #expect(one.positions == other.positions && one.triangles == other.triangles)
    #expect(restored.cube == base.cube && restored.depth == Self.depth)
  }

  @Test func damagedBytesAreRejectedOrHarmless() throws {
    let box = Self.boxes[2]
    let bytes = try base.encoded(for: box)
    func restore(_ bytes: [UInt8]) throws -> PoissonSolution {
      try bytes.withUnsafeBytes { try PoissonSolution(encoded: $0, for: box, KernelControl()) }
    }
    for count in [1, 8, 40, 48, 100, bytes.count / 2, bytes.count - 1] {
      #expect(throws: KernelError.self) { try restore(Array(bytes.prefix(count))) }
    }
    #expect(throws: KernelError.self) { try restore(bytes + [0]) }
    var random = SeededGenerator(seed: 3)
    for _ in 0..<50 {
      var damaged = bytes
      for _ in 0..<20 {
        damaged[Int(random.next() % UInt64(bytes.count))] ^= UInt8(1 << (random.next() % 8))
      }
      _ = try? restore(damaged).surface(KernelControl())
    }
  }

  @Test func threadsDoNotMatter() throws {
    let box = Self.boxes[3]
    #expect(
      try part(box, threads: 1).encoded(for: box) == part(box, threads: 3).encoded(for: box))
  }
}
