import Foundation
import SceneModel

/// Scenes for the evaluation of the dense stage, each with a different difficulty: an object of 0.3
/// m on a textured table, photographed from two rings. The object's mesh excludes the table.
package enum DenseScene: String, CaseIterable, Sendable {
  /// A statue with texture at all scales.
  case rich
  /// The same statue, cameras and light with a tenth of the contrast, and regions with even less.
  case lowTexture = "low-texture"
  /// Rods, a bent wire, a plate, a handle and leaves, 2 to 6 mm thick.
  case thin
  /// The insides of vessels, corners, deep grooves, an arch.
  case concave
  /// The rich scene with exposures and white balances that vary from photo to photo, and
  /// vignetting.
  case exposure

  /// - Parameters:
  ///   - width: width of the photos in pixels; the height is three quarters of it.
  ///   - poses: camera poses; nil selects the two rings.
  ///   - fineness: scales the number of the object's triangles per side.
  package func scene(
    width: Int = 1100, poses: [RigidTransform]? = nil, fineness: Double = 1
  ) -> RenderedScene {
    var scene = RenderedScene(
      object: RenderedScene.Surface(mesh: mesh(fineness), texture: texture),
      surroundings: [
        RenderedScene.Surface(mesh: RenderedScene.tableMesh(halfSide: 0.6), texture: table)
      ],
      camera: Camera(
        width: width, height: width * 3 / 4, focalLength: SIMD2(repeating: 1.3 * Double(width)),
        calibration: .exif),
      poses: poses ?? Self.rings([(14, elevations.lower), (10, elevations.upper)], around: middle),
      seed: 11)
    scene.noise = 1.5
    var photography = Photography()
    if self == .exposure {
      (photography.exposureStops, photography.whiteBalance) = (1, 0.08)
      photography.vignetting = 0.35
    }
    scene.photography = photography
    return scene
  }

  /// Cameras on rings around the object; each ring has a number of photos and an elevation in
  /// degrees.
  private static func rings(
    _ rings: [(count: Int, degrees: Double)], around height: Double
  ) -> [RigidTransform] {
    rings.enumerated().flatMap { ring, rows in
      (0..<rows.count).map { index in
        pose(
          turn: (Double(index) + 0.5 * Double(ring)) / Double(rows.count), degrees: rows.degrees,
          height: height)
      }
    }
  }

  /// Closely spaced cameras on a part of two rings, for small scenes.
  package static func arc(count: Int, stepDegrees: Double) -> [RigidTransform] {
    (0..<count).map { index in
      pose(
        turn: (Double(index) - Double(count - 1) / 2) * stepDegrees / 360,
        degrees: index.isMultiple(of: 2) ? 24 : 40)
    }
  }

  /// Photos from four rings, ordered by azimuth: the first n of them also form a set in which every
  /// photo has its neighbors.
  package static func sweep(count: Int) -> [RigidTransform] {
    let columns = (count + 3) / 4
    return (0..<count).map { index in
      let (column, ring) = (Double(index / 4), Double(index % 4))
      return pose(turn: (column + 0.25 * ring) / Double(columns), degrees: 15 + 15 * ring)
    }
  }

  static func pose(
    turn: Double, degrees: Double, height: Double = 0.125
  ) -> RigidTransform {
    let target = SIMD3<Double>(0, height, 0)
    let (azimuth, elevation) = (2 * .pi * turn, degrees * .pi / 180)
    let offset = SIMD3(
      cos(elevation) * sin(azimuth), sin(elevation), cos(elevation) * cos(azimuth))
    return RigidTransform.lookingAt(target, from: target + offset * 0.6)
  }

  /// The height that the cameras face.
  private var middle: Double { self == .concave ? 0.055 : 0.12 }

  private var elevations: (lower: Double, upper: Double) {
    self == .concave ? (28, 55) : (20, 46)
  }

  private func mesh(_ fineness: Double) -> Mesh {
    switch self {
    case .rich, .lowTexture, .exposure:
      RenderedScene.statueMesh(columns: Int(480 * fineness), rows: Int(360 * fineness))
    case .thin: ThinObjects(fineness: fineness).mesh
    case .concave: ConcaveObjects(fineness: fineness).mesh
    }
  }

  private var texture: SolidTexture {
    var texture = SolidTexture(
      palette: [
        [0.05, 0.035, 0.03], [0.42, 0.16, 0.08], [0.62, 0.50, 0.34], [0.16, 0.28, 0.30],
        [0.85, 0.80, 0.68],
      ],
      wavelength: 0.035, octaves: 7, seed: 21)
    if self == .exposure {
      // Prevents clipping of the light parts in the brightest photos.
      texture.palette = texture.palette.map { $0 * 0.7 }
    }
    if self == .lowTexture {
      texture = texture.withContrast(0.12)
      texture.plainWavelength = 0.06
    }
    return texture
  }

  private var table: SolidTexture {
    SolidTexture(
      palette: [[0.10, 0.06, 0.035], [0.36, 0.24, 0.13], [0.58, 0.47, 0.33]],
      wavelength: 0.05, octaves: 7, seed: 98)
  }
}
