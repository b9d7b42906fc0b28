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
    let target = SIMD3<Double>(0, 0.128, 0)  // Chosen.
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
      return RigidTransform.lookingAt(target, from: target + offset * 0.6)
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

  /// A surface around the y axis that stands on y = 0; its bottom is open.
  package static func statueMesh(columns: Int, rows: Int) -> Mesh {
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

  /// A square at y = 0 that faces up.
  package static func tableMesh(halfSide a: Float) -> Mesh {
    Mesh(
      positions: [[-a, 0, a], [a, 0, a], [a, 0, -a], [-a, 0, -a]],
      normals: Array(repeating: [0, 1, 0], count: 4),
      triangles: [Triangle(0, 1, 2), Triangle(0, 2, 3)])
  }
}
