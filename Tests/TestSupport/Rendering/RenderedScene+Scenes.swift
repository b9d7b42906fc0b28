import Foundation
import SceneModel

extension RenderedScene {
  /// An irregular statue, 30 cm high, on a table, photographed on a full ring from slightly above
  /// and on a smaller one from higher up.
  ///
  /// - Parameters:
  ///   - upperCount: number of photos that form the upper ring.
  ///   - meshColumns: vertices around the statue; the reference mesh has about half as many rows.
  ///   - textureContrast: deviation of the colors from their mean, 0…1.
  package static func statue(
    photoCount: Int = 20, upperCount: Int = 6, width: Int = 800, height: Int = 600,
    meshColumns: Int = 120, textureContrast: Float = 1, seed: UInt64 = 1
  ) -> RenderedScene {
    let lowerCount = photoCount - upperCount
    let target = SIMD3<Double>(0, 0.128, 0)
    let poses = (0..<photoCount).map { index in
      let isLower = index < lowerCount
      let turn =
        isLower
        ? Double(index) / Double(max(1, lowerCount))
        : (Double(index - lowerCount) + 0.5) / Double(max(1, upperCount))
      let elevation = (isLower ? 22.0 : 48.0) * .pi / 180
      let azimuth = 2 * .pi * turn
      let offset = SIMD3(
        cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
      return SyntheticScene.lookingAt(target, from: target + offset * 0.6)
    }
    let focalLength = Double(width) * 1.15
    return RenderedScene(
      object: Surface(
        mesh: statueMesh(columns: meshColumns, rows: meshColumns * 8 / 15),
        texture: SolidTexture(
          palette: [
            [0.05, 0.035, 0.03], [0.42, 0.16, 0.08], [0.62, 0.50, 0.34], [0.16, 0.28, 0.30],
            [0.85, 0.80, 0.68],
          ],
          wavelength: 0.05, octaves: 6, seed: UInt32(truncatingIfNeeded: seed)
        ).withContrast(textureContrast)),
      surroundings: [
        Surface(
          mesh: tableMesh(halfSide: 0.5),
          texture: SolidTexture(
            palette: [[0.10, 0.06, 0.035], [0.36, 0.24, 0.13], [0.58, 0.47, 0.33]],
            wavelength: 0.09, octaves: 6, seed: UInt32(truncatingIfNeeded: seed &+ 77)
          ).withContrast(textureContrast))
      ],
      camera: Camera(
        width: width, height: height, focalLength: SIMD2(repeating: focalLength),
        calibration: .exif),
      poses: poses, seed: seed)
  }

  /// The statue with very low contrast and the noise of a sensor in low light: hardly any texture.
  package static func faintStatue(
    photoCount: Int = 20, upperCount: Int = 6, width: Int = 800, height: Int = 600
  ) -> RenderedScene {
    var scene = statue(
      photoCount: photoCount, upperCount: upperCount, width: width, height: height,
      textureContrast: 0.1)
    scene.noise = 2
    return scene
  }

  /// A wall of 4 × 3 m with niches, columns and ornaments, photographed on an arc in front of it.
  package static func relief(
    photoCount: Int = 12, width: Int = 800, height: Int = 600, meshColumns: Int = 100,
    seed: UInt64 = 2
  ) -> RenderedScene {
    let poses = (0..<photoCount).map { index in
      let t = photoCount > 1 ? 2 * Double(index) / Double(photoCount - 1) - 1 : 0
      let angle = t * 38 * .pi / 180
      let height = index.isMultiple(of: 2) ? 1.2 : 1.9
      let target = SIMD3(0.35 * sin(2 * angle), 1.5, 0.0)
      return SyntheticScene.lookingAt(
        target, from: [4.6 * sin(angle), height, 4.6 * cos(angle)])
    }
    let focalLength = Double(width) * 1.05
    return RenderedScene(
      object: Surface(
        mesh: reliefMesh(columns: meshColumns, rows: meshColumns * 3 / 4),
        texture: SolidTexture(
          palette: [
            [0.10, 0.08, 0.07], [0.45, 0.36, 0.27], [0.66, 0.56, 0.44], [0.36, 0.20, 0.13],
            [0.82, 0.76, 0.66],
          ],
          wavelength: 0.45, octaves: 6, seed: UInt32(truncatingIfNeeded: seed))),
      surroundings: [],
      camera: Camera(
        width: width, height: height, focalLength: SIMD2(repeating: focalLength)),
      poses: poses, seed: seed)
  }

  /// A surface around the y axis that stands on y = 0; its bottom is open.
  static func statueMesh(columns: Int, rows: Int) -> Mesh {
    func radius(_ angle: Double, _ h: Double) -> Double {
      func bump(_ at: Double, _ height: Double, _ width: Double, _ tallness: Double) -> Double {
        let turn = atan2(sin(angle - at), cos(angle - at)) / width
        let rise = (h - height) / tallness
        return exp(-turn * turn - rise * rise)
      }
      // Plinth, waist, body, neck and head.
      let plinth = 0.085 / (1 + exp((h - 0.13) * 90)) * (1 + 0.08 * cos(4 * angle))
      let body = 0.058 * exp(-pow((h - 0.42) / 0.20, 2)) * (1 + 0.16 * cos(2 * angle + 0.4))
      let head = 0.046 * exp(-pow((h - 0.84) / 0.13, 2))
      let bumps =
        0.026 * bump(0.2, 0.80, 0.35, 0.06) + 0.034 * bump(1.7, 0.52, 0.40, 0.10)
        + 0.036 * bump(-1.5, 0.44, 0.38, 0.13) + 0.020 * bump(3.0, 0.64, 0.5, 0.07)
        + 0.016 * bump(2.3, 0.27, 0.3, 0.05) - 0.012 * bump(0.9, 0.36, 0.35, 0.08)
      let folds = 0.0035 * sin(9 * angle + 14 * h) * exp(-pow((h - 0.4) / 0.22, 2))
      // Rounded toward the top.
      let cap = max(0, 1 - pow(max(0, (h - 0.80) / 0.20), 3)).squareRoot()
      return max(0.012, plinth + body + head + bumps + folds + 0.012) * cap
    }
    return grid(columns: columns, rows: rows, isClosed: true) { u, v in
      let (angle, h) = (2 * .pi * u, v)
      let r = radius(angle, h)
      return SIMD3(r * sin(angle), 0.27 * h, r * cos(angle))
    }
  }

  private static func reliefMesh(columns: Int, rows: Int) -> Mesh {
    func step(_ x: Double, _ edge: Double, _ softness: Double) -> Double {
      1 / (1 + exp(-(x - edge) / softness))
    }
    func box(_ x: Double, _ center: Double, _ half: Double) -> Double {
      step(x, center - half, 0.025) * (1 - step(x, center + half, 0.025))
    }
    return grid(columns: columns, rows: rows, isClosed: false) { u, v in
      let (x, y) = (4 * u - 2, 3 * v)
      var z = 0.03 * sin(1.7 * x + 0.6) * cos(2.1 * y)
      for center in [-1.25, 0.0, 1.25] { z -= 0.28 * box(x, center, 0.30) * box(y, 1.35, 0.62) }
      for center in [-0.63, 0.63] {
        let across = (x - center) / 0.14
        z += 0.20 * max(0, 1 - across * across).squareRoot() * box(y, 1.4, 1.0)
      }
      z += 0.22 * box(y, 2.62, 0.10) + 0.14 * box(y, 0.22, 0.14)
      for (ox, oy) in [(-1.25, 1.25), (0.0, 1.45), (1.25, 1.15)] {
        let d = pow((x - ox) / 0.16, 2) + pow((y - oy) / 0.24, 2)
        z += 0.24 * exp(-d)
      }
      return SIMD3(x, y, z)
    }
  }

  static func tableMesh(halfSide a: Float) -> Mesh {
    Mesh(
      positions: [[-a, 0, a], [a, 0, a], [a, 0, -a], [-a, 0, -a]],
      normals: Array(repeating: [0, 1, 0], count: 4),
      triangles: [Triangle(0, 1, 2), Triangle(0, 2, 3)])
  }

  /// A mesh over the unit square, u to the right and v up, counter-clockwise from outside; closed
  /// in u if `isClosed`. Normals are finite differences of the positions.
  static func grid(
    columns: Int, rows: Int, isClosed: Bool, _ position: (Double, Double) -> SIMD3<Double>
  ) -> Mesh {
    var mesh = Mesh()
    let span = Double(isClosed ? columns : columns - 1)
    for row in 0..<rows {
      for column in 0..<columns {
        let (u, v) = (Double(column) / span, Double(row) / Double(rows - 1))
        let (du, dv) = (0.25 / span, 0.25 / Double(rows - 1))
        let right = position(u + du, v) - position(u - du, v)
        let up = position(u, min(1, v + dv)) - position(u, max(0, v - dv))
        let normal = right.cross(up).normalized
        mesh.positions.append(SIMD3<Float>(position(u, v)))
        mesh.normals.append(
          normal == .zero || !normal.x.isFinite ? [0, 1, 0] : SIMD3<Float>(normal))
      }
    }
    func index(_ row: Int, _ column: Int) -> UInt32 { UInt32(row * columns + column % columns) }
    for row in 0..<rows - 1 {
      for column in 0..<(isClosed ? columns : columns - 1) {
        let (a, b) = (index(row, column), index(row, column + 1))
        let (c, d) = (index(row + 1, column + 1), index(row + 1, column))
        mesh.triangles.append(Triangle(a, b, c))
        // The top row of a closed grid is a single point.
        if !(isClosed && row == rows - 2) { mesh.triangles.append(Triangle(a, c, d)) }
      }
    }
    return mesh
  }
}
