import Foundation
import SceneModel

extension RenderedScene {
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
      return RigidTransform.lookingAt(
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
}
