import Foundation
import SceneModel

/// What surrounds the object of a `CaptureScene`: a table 2.6 m wide, at y = 0, and a round wall of
/// 1.2 m radius.
package enum CaptureSurroundings: String, CaseIterable, Sendable {
  /// Table and wall with more contrast than the object.
  case textured
  /// Gray-beige, only slightly uneven over large distances.
  case plain
  /// Velvet that reflects a hundredth of the light.
  case black
  /// White paper.
  case white

  /// Table and wall.
  func surfaces(seed: UInt32) -> [RenderedScene.Surface] {
    let wall = RenderedScene.grid(columns: 181, rows: 2, isClosed: false) { u, v in
      let angle = -2 * Double.pi * u
      return SIMD3(1.2 * sin(angle), 0.5 * v, 1.2 * cos(angle))
    }
    return [
      RenderedScene.Surface(
        mesh: RenderedScene.tableMesh(halfSide: 1.3), texture: table(seed: seed)),
      RenderedScene.Surface(mesh: wall, texture: self.wall(seed: seed &+ 1)),
    ]
  }

  private func table(seed: UInt32) -> SolidTexture {
    switch self {
    case .textured:
      SolidTexture(
        palette: [[0.04, 0.02, 0.015], [0.30, 0.17, 0.08], [0.72, 0.60, 0.42]],
        wavelength: 0.06, octaves: 7, seed: seed, contrast: 4)
    case .plain: Self.uneven([0.48, 0.44, 0.38], seed)
    case .black: Self.uniform(0.01)
    case .white: Self.uniform(0.8)
    }
  }

  private func wall(seed: UInt32) -> SolidTexture {
    switch self {
    case .textured:
      SolidTexture(
        palette: [
          [0.05, 0.08, 0.05], [0.20, 0.32, 0.40], [0.75, 0.70, 0.55], [0.45, 0.16, 0.08],
        ],
        wavelength: 0.22, octaves: 7, seed: seed, contrast: 2.5)
    case .plain: Self.uneven([0.52, 0.49, 0.44], seed)
    case .black, .white: table(seed: seed)
    }
  }

  /// A texture of one octave that deviates from `color` by 3 percent.
  private static func uneven(_ color: SIMD3<Float>, _ seed: UInt32) -> SolidTexture {
    SolidTexture(
      palette: [color * 0.97, color * 1.03], wavelength: 0.7, octaves: 1, seed: seed)
  }

  private static func uniform(_ albedo: Float) -> SolidTexture {
    SolidTexture(palette: [SIMD3(repeating: albedo)], wavelength: 1, octaves: 1, seed: 1)
  }
}

/// The plate of a turntable: a disc of 17 cm radius around the y axis, on the table.
enum CapturePlate {
  /// Height of its upper side in meters.
  static let height = 0.012

  /// The plate, turned by `roomFromPlate` together with its texture of weak contrast.
  static func surface(_ roomFromPlate: RigidTransform, seed: UInt32) -> RenderedScene.Surface {
    let mesh = Mesh.turned(
      [
        [0.17, 0], [0.17, 0.006], [0.17, 0.01], [0.168, height], [0.16, height], [0.11, height],
        [0.05, height], [0, height],
      ], columns: 180, rows: 40)
    let texture = SolidTexture(
      palette: [[0.16, 0.15, 0.14], [0.30, 0.29, 0.27], [0.46, 0.44, 0.40]], wavelength: 0.05,
      octaves: 6, seed: seed
    ).withContrast(0.25)
    return RenderedScene.Surface(
      mesh: mesh.deformed(), texture: texture, textureFromWorld: roomFromPlate.inverse)
  }
}
