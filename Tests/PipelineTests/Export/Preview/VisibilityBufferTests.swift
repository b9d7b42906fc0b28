import SceneModel
import TestSupport
import Testing

@testable import Pipeline

@Suite struct VisibilityBufferTests {
  private let side = 24

  private func vertex(_ x: Int, _ y: Int, depth: Float = 1) -> ScreenVertex {
    ScreenVertex(x: Int32(x), y: Int32(y), inverseDepth: 1 / depth)
  }

  /// A position in or near the picture, often at the center of a sample.
  private func place(_ generator: inout SeededGenerator) -> (x: Int, y: Int) {
    let range = -400...(side * 256 + 400)
    let (x, y) = (
      Int.random(in: range, using: &generator), Int.random(in: range, using: &generator)
    )
    return Bool.random(using: &generator) ? (x & ~127, y & ~127) : (x, y)
  }

  private func covered(_ a: ScreenVertex, _ b: ScreenVertex, _ c: ScreenVertex) -> [Bool] {
    var buffer = VisibilityBuffer(width: side, height: side)
    buffer.draw(7, a, b, c)
    return buffer.triangles.map { $0 == 7 }
  }

  @Test func aTriangleCoversTheSampleCentersInside() {
    var generator = SeededGenerator(seed: 1)
    for _ in 0..<300 {
      let corners = (0..<3).map { _ in place(&generator) }
      let covered = covered(
        vertex(corners[0].x, corners[0].y), vertex(corners[1].x, corners[1].y),
        vertex(corners[2].x, corners[2].y))
      for index in covered.indices {
        let (x, y) = (index % side * 256 + 128, index / side * 256 + 128)
        let sides = (0..<3).map { corner in
          let (p, q) = (corners[corner], corners[(corner + 1) % 3])
          return ((q.x - p.x) * (y - p.y) - (q.y - p.y) * (x - p.x)).signum()
        }
        if sides.allSatisfy({ $0 > 0 }) || sides.allSatisfy({ $0 < 0 }) {
          #expect(covered[index])
        } else if sides.contains(1), sides.contains(-1) {
          #expect(!covered[index])
        }
      }
    }
  }

  /// Detects both overlaps and cracks: a mesh over the whole picture.
  @Test func adjacentTrianglesNeitherOverlapNorLeaveCracks() {
    var generator = SeededGenerator(seed: 2)
    for isExact in [true, false] {
      let cells = 4
      let step = (side * 256 + 512) / cells
      let net = (0...cells).map { row in
        (0...cells).map { column -> ScreenVertex in
          let isInner = (1..<cells).contains(row) && (1..<cells).contains(column)
          let shift = isInner ? step / 6 : 0
          var x = column * step - 256 + Int.random(in: -shift...shift, using: &generator)
          var y = row * step - 256 + Int.random(in: -shift...shift, using: &generator)
          // At sample centers, the edge rule decides.
          if isExact, isInner { (x, y) = (x & ~255 | 128, y & ~255 | 128) }
          return vertex(x, y)
        }
      }
      var counts = [Int](repeating: 0, count: side * side)
      for row in 0..<cells {
        for column in 0..<cells {
          let (a, b) = (net[row][column], net[row][column + 1])
          let (c, d) = (net[row + 1][column], net[row + 1][column + 1])
          // One of the two is a back face.
          for corners in [(a, b, d), (a, c, d)] {
            for (index, isCovered) in covered(corners.0, corners.1, corners.2).enumerated()
            where isCovered { counts[index] += 1 }
          }
        }
      }
      #expect(counts.allSatisfy { $0 == 1 })
    }
  }

  @Test func nearerTriangleIsVisible() {
    for nearFirst in [true, false] {
      var buffer = VisibilityBuffer(width: side, height: side)
      for index in 0..<2 {
        let depth: Float = (index == 0) == nearFirst ? 2 : 3
        buffer.draw(
          Int32(index), vertex(0, 0, depth: depth), vertex(4000, 0, depth: depth),
          vertex(0, 4000, depth: depth))
      }
      #expect(Set(buffer.triangles) == [-1, nearFirst ? 0 : 1])
    }
  }

  @Test func trianglesCrossWhereTheirDepthsAreEqual() {
    let size = Int32(side * 256)
    func corner(_ x: Int32, _ y: Int32, _ inverseDepth: Float) -> ScreenVertex {
      ScreenVertex(x: x, y: y, inverseDepth: inverseDepth)
    }
    // One is perpendicular at depth 2; the other extends from depth 1 on the left to infinity on
    // the right, so that halfway its inverse depth equals that of the first.
    var buffer = VisibilityBuffer(width: side, height: side)
    buffer.draw(
      0, corner(-size, -size, 0.5), corner(3 * size, -size, 0.5), corner(-size, 3 * size, 0.5))
    buffer.draw(1, corner(0, -size, 1), corner(size, size / 2, 0), corner(0, 2 * size, 1))
    for x in 0..<side {
      #expect(buffer.triangles[side / 2 * side + x] == (x < side / 2 ? 1 : 0))
    }
  }

  @Test func degenerateTrianglesCoverNothing() {
    #expect(!covered(vertex(0, 0), vertex(1000, 1000), vertex(3000, 3000)).contains(true))
    #expect(!covered(vertex(128, 128), vertex(128, 128), vertex(128, 128)).contains(true))
  }
}
