import Foundation
import SceneModel
import SceneRendering

/// A town of houses that a car with cameras drives through: the rendered counterpart of
/// `GrowthScene`'s layout `streets`. It grows with the number of photos.
package struct TownScene: Sendable {
  /// Standard deviations of GPS, horizontal and vertical, in meters: those of a phone under open
  /// sky. Chosen.
  private static let (horizontalError, verticalError) = (2.5, 5.0)

  package let scene: RenderedScene
  private let seed: UInt64

  package init(photoCount: Int, seed: UInt64 = 1, width: Int = 1200) {
    self.seed = seed
    var random = SeededGenerator(seed: seed)
    let town = GrowthTown(photoCount: photoCount)
    let houses = town.facades.map { TownHouse($0, &random).mesh }
    let poses = town.drive(photoCount: photoCount, &random)
    var all = Mesh()
    houses.forEach { all.append($0) }
    let bounds = all.bounds ?? (min: .zero, max: .zero)
    scene = RenderedScene(
      object: RenderedScene.Surface(mesh: all, texture: TownTexture(seed: seed)),
      surroundings: [
        RenderedScene.Surface(
          mesh: Self.ground(from: bounds.min, to: bounds.max), texture: Self.asphalt(seed))
      ],
      camera: Camera(
        width: width, height: width * 3 / 4,
        focalLength: SIMD2(repeating: 0.75 * Double(width)), calibration: .exif),
      poses: poses, seed: seed)
  }

  private static func ground(from low: SIMD3<Float>, to high: SIMD3<Float>) -> Mesh {
    RenderedScene.grid(columns: 2, rows: 2, isClosed: false) { u, v in
      SIMD3(
        Double(low.x) + u * Double(high.x - low.x), 0,
        Double(high.z) - v * Double(high.z - low.z))
    }
  }

  private static func asphalt(_ seed: UInt64) -> SolidTexture {
    SolidTexture(
      palette: [[0.04, 0.04, 0.045], [0.12, 0.12, 0.12], [0.22, 0.21, 0.20]], wavelength: 2.5,
      octaves: 8, seed: UInt32(truncatingIfNeeded: seed &+ 5))
  }

  /// The file name of a photo.
  package static func name(_ index: Int) -> String { String(format: "IMG_%05d.jpg", index) }

  /// Where GPS places a photo, with its error, in degrees and meters. North is −z.
  package func position(
    _ index: Int
  ) -> (latitude: Double, longitude: Double, altitude: Double) {
    var random = SeededGenerator(seed: seed &* 31 &+ UInt64(index))
    let error = random.normal3() * [Self.horizontalError, Self.verticalError, Self.horizontalError]
    let place = scene.poses[index].center + error
    let metersPerDegree = 111_320.0  // Limit: the mean length of a degree of latitude.
    let latitude = 50 - place.z / metersPerDegree
    return (
      latitude, 10 + place.x / metersPerDegree / cos(50 * .pi / 180), 120 + place.y
    )
  }
}

/// The colors of all houses: each has its own, with bricks and stains.
struct TownTexture: SurfaceTexture {
  private static let palettes: [[SIMD3<Float>]] = [
    [[0.20, 0.08, 0.05], [0.42, 0.18, 0.11], [0.60, 0.36, 0.24]],
    [[0.30, 0.26, 0.18], [0.58, 0.50, 0.36], [0.80, 0.74, 0.60]],
    [[0.16, 0.18, 0.20], [0.36, 0.38, 0.40], [0.62, 0.63, 0.62]],
    [[0.36, 0.22, 0.06], [0.64, 0.44, 0.16], [0.82, 0.68, 0.40]],
    [[0.10, 0.16, 0.12], [0.26, 0.38, 0.30], [0.54, 0.60, 0.50]],
  ]

  private let textures: [SolidTexture]
  private let seed: UInt64

  init(seed: UInt64) {
    self.seed = seed
    textures = Self.palettes.enumerated().map { index, palette in
      SolidTexture(
        palette: palette, wavelength: 1.4, octaves: 7,
        seed: UInt32(truncatingIfNeeded: seed &* 7 &+ UInt64(index)))
    }
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    // The colors change about twice along a block of the town.
    let cell = (point / 14).rounded(.down)
    var hash = SeededGenerator(
      seed: seed &+ UInt64(bitPattern: Int64(cell.x)) &* 73_856_093
        &+ UInt64(bitPattern: Int64(cell.z)) &* 19_349_663)
    let texture = textures[Int(hash.next() % UInt64(textures.count))]
    return texture.color(at: point, footprint: footprint)
  }
}
