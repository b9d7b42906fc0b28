import Foundation
import SceneModel

/// Solids for building scenes, with vertex normals, counter-clockwise from outside.
extension Mesh {
  /// Appends another mesh.
  package mutating func append(_ other: Mesh) {
    let first = UInt32(positions.count)
    positions += other.positions
    normals += other.normals
    triangles += other.triangles.map { Triangle($0.a + first, $0.b + first, $0.c + first) }
  }

  /// The mesh with other positions, and vertex normals that are the means of the normals of the
  /// adjacent triangles, weighted by area. Vertices that only coincide are not joined: there the
  /// mesh keeps its sharp edges.
  package func deformed(_ position: (SIMD3<Double>) -> SIMD3<Double> = { $0 }) -> Mesh {
    var result = self
    result.positions = positions.map { SIMD3<Float>(position(SIMD3<Double>($0))) }
    let p = result.positions
    var sums = [SIMD3<Float>](repeating: .zero, count: p.count)
    for t in triangles {
      let corners = [Int(t.a), Int(t.b), Int(t.c)]
      let normal = (p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]])
      for corner in corners { sums[corner] += normal }
    }
    result.normals = sums.map { $0.squaredLength > 0 ? $0.normalized : [0, 1, 0] }
    return result
  }

  /// The mesh moved by a rigid transform.
  package func moved(by transform: RigidTransform) -> Mesh {
    var result = self
    result.positions = positions.map { SIMD3<Float>(transform * SIMD3<Double>($0)) }
    result.normals = normals.map { SIMD3<Float>(transform.rotation * SIMD3<Double>($0)) }
    return result
  }

  /// Closes the open bottom of a surface around the y axis, whose first `columns` vertices are its
  /// lower edge in counterclockwise order seen from above, by a plane fan.
  mutating func closeBottom(columns: Int) {
    let (edge, first) = (Array(positions.prefix(columns)), UInt32(positions.count))
    positions += edge + [edge.reduce(.zero, +) / Float(max(1, columns))]
    normals += Array(repeating: [0, -1, 0], count: columns + 1)
    let center = first + UInt32(columns)
    for column in 0..<UInt32(columns) {
      let next = (column + 1) % UInt32(columns)
      triangles.append(Triangle(center, first + next, first + column))
    }
  }

  /// The mesh rotated about the y axis by `angle` radians, then translated.
  package func placed(turned angle: Double = 0, at offset: SIMD3<Double>) -> Mesh {
    let rotation = Quaternion(angle: angle, axis: [0, 1, 0])
    var result = self
    result.positions = positions.map { SIMD3<Float>(rotation * SIMD3<Double>($0) + offset) }
    result.normals = normals.map { SIMD3<Float>(rotation * SIMD3<Double>($0)) }
    return result
  }

  /// A box with faces of `cells` × `cells` squares.
  package static func box(
    center: SIMD3<Double>, halfSize h: SIMD3<Double>, cells: Int = 1
  ) -> Mesh {
    var mesh = Mesh()
    for axis in 0..<3 {
      for sign in [-1.0, 1.0] {
        var (normal, u) = (SIMD3<Double>.zero, SIMD3<Double>.zero)
        normal[axis] = sign
        u[(axis + 1) % 3] = 1
        let v = normal.cross(u)
        let first = UInt32(mesh.positions.count)
        for row in 0...cells {
          for column in 0...cells {
            let (a, b) = (
              2 * Double(column) / Double(cells) - 1, 2 * Double(row) / Double(cells) - 1
            )
            mesh.positions.append(SIMD3<Float>(center + (normal + a * u + b * v) * h))
            mesh.normals.append(SIMD3<Float>(normal))
          }
        }
        for row in 0..<cells {
          for column in 0..<cells {
            let a = first + UInt32(row * (cells + 1) + column)
            let d = a + UInt32(cells + 1)
            mesh.triangles += [Triangle(a, a + 1, d + 1), Triangle(a, d + 1, d)]
          }
        }
      }
    }
    return mesh
  }

  /// A box around the origin with rounded edges; its cells are denser there.
  static func roundedBox(halfSize h: SIMD3<Double>, radius: Double, cells: Int) -> Mesh {
    var mesh = box(center: .zero, halfSize: [1, 1, 1], cells: cells)
    for (index, position) in mesh.positions.enumerated() {
      let p = SIMD3<Double>(position)
      let point = SIMD3(sin(p.x * .pi / 2), sin(p.y * .pi / 2), sin(p.z * .pi / 2)) * h
      let core = point.clamped(
        lowerBound: SIMD3(repeating: radius) - h, upperBound: h - SIMD3(repeating: radius))
      let normal = (point - core).normalized
      mesh.positions[index] = SIMD3<Float>(core + normal * radius)
      mesh.normals[index] = SIMD3<Float>(normal)
    }
    return mesh
  }

  /// A closed tube with rounded ends and an elliptical cross section along a path over 0…1.
  ///
  /// - Parameters:
  ///   - side: a direction that is never parallel to the path; the first half axis is perpendicular
  ///     to it and to the path.
  ///   - halfAxes: half axes of the cross section in the middle of the path.
  ///   - length: length of the path, which the rounding at its ends requires.
  ///   - widening: scales the first half axis along the path.
  package static func tube(
    along path: (Double) -> SIMD3<Double>, side: SIMD3<Double>, halfAxes: SIMD2<Double>,
    length: Double, columns: Int = 24, rows: Int = 160, widening: (Double) -> Double = { _ in 1 }
  ) -> Mesh {
    RenderedScene.grid(columns: columns, rows: rows, isClosed: true) { u, v in
      // Rows are denser at the rounded ends.
      let s = 0.5 - 0.5 * cos(.pi * min(max(v, 0), 1))
      let along = (path(min(1, s + 1e-4)) - path(max(0, s - 1e-4))).normalized
      let across = side.cross(along).normalized
      let up = across.cross(along)
      let rest = min(s, 1 - s) * length / halfAxes.y
      let round = rest < 1 ? (rest * (2 - rest)).squareRoot() : 1
      let angle = 2 * .pi * u
      return path(s) + across * (sin(angle) * halfAxes.x * round * widening(s))
        + up * (cos(angle) * halfAxes.y * round)
    }
  }

  /// A straight rod with rounded ends.
  package static func rod(
    from a: SIMD3<Double>, to b: SIMD3<Double>, radius: Double, columns: Int = 24, rows: Int = 120
  ) -> Mesh {
    let direction = (b - a).normalized
    return tube(
      along: { a + (b - a) * $0 }, side: abs(direction.x) < 0.7 ? [1, 0, 0] : [0, 0, 1],
      halfAxes: SIMD2(repeating: radius), length: (b - a).length, columns: columns, rows: rows)
  }

  /// A surface of revolution about the y axis. The profile runs through (radius, height) from the
  /// bottom of the outside over the edge to the inside, as a Catmull–Rom spline.
  package static func turned(
    _ profile: [SIMD2<Double>], columns: Int = 200, rows: Int = 240,
    fluting: (Double) -> Double = { _ in 1 }
  ) -> Mesh {
    RenderedScene.grid(columns: columns, rows: rows, isClosed: true) { u, v in
      let p = spline(profile, at: min(max(v, 0), 1))
      let angle = 2 * .pi * u
      let radius = max(0, p.x) * fluting(angle)
      return SIMD3(radius * sin(angle), p.y, radius * cos(angle))
    }
  }

  private static func spline(_ points: [SIMD2<Double>], at v: Double) -> SIMD2<Double> {
    let position = v * Double(points.count - 1)
    let index = min(Int(position), points.count - 2)
    let t = position - Double(index)
    let p = (-1...2).map { points[min(max(index + $0, 0), points.count - 1)] }
    let linear = (p[2] - p[0]) * t
    let square = (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) * (t * t)
    let cubic = (3 * p[1] - p[0] - 3 * p[2] + p[3]) * (t * t * t)
    return p[1] + (linear + square + cubic) / 2
  }
}
