import Foundation
import SceneModel

/// Scenes with repeated structure.
extension RenderedScene {
  /// A box that is symmetric under a half turn, or has four different sides, on a table of one
  /// color, photographed on a full ring. Different balls next to it make the sides distinguishable.
  package static func twinBox(
    photoCount: Int = 16, width: Int = 480, height: Int = 360, ballCount: Int = 3,
    isRepeated: Bool = true
  ) -> RenderedScene {
    let poses = (0..<photoCount).map { index in
      let azimuth = 2 * .pi * Double(index) / Double(photoCount)
      let elevation = 25 * Double.pi / 180
      let offset = SIMD3(
        cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
      return RigidTransform.lookingAt([0, 0.08, 0], from: SIMD3(0, 0.08, 0) + offset * 0.75)
    }
    let places: [SIMD3<Double>] = [[0.19, 0.045, 0.1], [-0.04, 0.04, 0.2], [-0.2, 0.05, -0.08]]
    return RenderedScene(
      object: Surface(
        mesh: Mesh.box(center: [0, 0.11, 0], halfSize: [0.12, 0.11, 0.08]),
        texture: SolidTexture(
          palette: [[0.06, 0.04, 0.03], [0.55, 0.2, 0.1], [0.3, 0.4, 0.45], [0.85, 0.8, 0.7]],
          wavelength: 0.05, octaves: 6, seed: 3,
          repetition: isRepeated ? .halfTurn : .none)),
      surroundings: [
        Surface(
          mesh: tableMesh(halfSide: 0.6),
          texture: SolidTexture(palette: [[0.3, 0.3, 0.3]], wavelength: 1, octaves: 1, seed: 1))
      ]
        + places.prefix(ballCount).enumerated().map { index, place in
          Surface(
            mesh: ball(center: place, radius: place.y),
            texture: SolidTexture(
              palette: [[0.05, 0.1, 0.2], [0.6, 0.5, 0.1], [0.2, 0.5, 0.3], [0.9, 0.9, 0.85]],
              wavelength: 0.03, octaves: 5, seed: UInt32(100 + index)))
        },
      camera: Camera(
        width: width, height: height, focalLength: SIMD2(repeating: 1.15 * Double(width)),
        calibration: .exif),
      poses: poses)
  }

  /// A wall of bays with a pillar and a panel each, with the same texture or different ones,
  /// photographed while walking along it. Balls in front of some of the bays make them
  /// distinguishable.
  package static func facade(
    photoCount: Int = 14, width: Int = 480, height: Int = 360, ballCount: Int = 3,
    isRepeated: Bool = true
  ) -> RenderedScene {
    let (bay, bays) = (1.5, 6)
    let length = bay * Double(bays)
    var wall = Mesh()
    wall.append(.box(center: [0, 1.2, -0.1], halfSize: [length / 2, 1.2, 0.1]))
    for index in 0..<bays {
      let x = (Double(index) + 0.5) * bay - length / 2
      wall.append(.box(center: [x, 1.2, 0.1], halfSize: [0.18, 1.2, 0.1]))
    }
    let poses = (0..<photoCount).map { index in
      let x = (Double(index) / Double(max(1, photoCount - 1)) - 0.5) * (length - 2)
      let height = index.isMultiple(of: 2) ? 1.1 : 1.4
      return RigidTransform.lookingAt([x + 0.1, 1.2, 0], from: [x, height, 2.6])
    }
    return RenderedScene(
      object: Surface(
        mesh: wall,
        texture: SolidTexture(
          palette: [
            [0.1, 0.08, 0.07], [0.45, 0.36, 0.27], [0.36, 0.2, 0.13], [0.82, 0.76, 0.66],
          ],
          wavelength: 0.4, octaves: 6, seed: 5,
          repetition: isRepeated ? .period(Float(bay)) : .none)),
      surroundings: (0..<ballCount).map { index in
        let place = SIMD3([-2.9, 0.2, 2.6][index % 3], [0.5, 0.8, 0.4][index % 3], 0.5)
        return Surface(
          mesh: ball(center: place, radius: 0.28),
          texture: SolidTexture(
            palette: [[0.05, 0.1, 0.2], [0.6, 0.5, 0.1], [0.2, 0.5, 0.3], [0.9, 0.9, 0.85]],
            wavelength: 0.2, octaves: 5, seed: UInt32(200 + index)))
      },
      camera: Camera(
        width: width, height: height, focalLength: SIMD2(repeating: 1.0 * Double(width)),
        calibration: .exif),
      poses: poses)
  }

  private static func ball(center: SIMD3<Double>, radius: Double) -> Mesh {
    grid(columns: 24, rows: 13, isClosed: true) { u, v in
      let (angle, h) = (2 * .pi * u, .pi * (v - 0.5))
      return center + radius * SIMD3(cos(h) * sin(angle), sin(h), cos(h) * cos(angle))
    }
  }
}
