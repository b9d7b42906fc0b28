import Foundation
import SceneModel

/// A wallpaper in planes of constant z: one irregular flower that repeats exactly on a half-drop
/// lattice, that is, every other column is shifted by half of the vertical period.
package struct WallpaperTexture: SurfaceTexture {
  /// Distance of adjacent columns, and of the flowers in a column, in meters. The flowers repeat
  /// when moved by `[0, period.y]` or by `[period.x, period.y / 2]`.
  package let period: SIMD2<Float>
  /// How much the brightness varies over the wall, independent of the flowers.
  package var unevenness: Float = 0.04
  private let flower: [Ellipse]
  private let paper: SIMD3<Float>
  /// Multiplies the colors of the flower, the same in each of them.
  private let detail: SolidTexture
  private let seed: UInt32

  /// A part of the flower, relative to the middle of its cell.
  private struct Ellipse: Sendable {
    var center: SIMD2<Float>
    /// The unit vector along its first half axis.
    var direction: SIMD2<Float>
    var halfAxes: SIMD2<Float>
    var color: SIMD3<Float>

    /// A distance to its edge in meters that is negative inside.
    func distance(_ point: SIMD2<Float>) -> Float {
      let offset = point - center
      let along = (offset * direction).sum()
      let across = offset.y * direction.x - offset.x * direction.y
      let scaled = SIMD2(along, across) / halfAxes
      return (scaled.squaredLength.squareRoot() - 1) * halfAxes.min()
    }
  }

  package init(seed: UInt32) {
    var random = SeededGenerator(seed: UInt64(seed))
    self.seed = seed
    period = SIMD2<Float>([0.15 + 0.04 * random.uniform(), 0.16 + 0.04 * random.uniform()])
    paper = SIMD3<Float>(
      [0.55, 0.5, 0.42] + 0.15 * SIMD3(random.uniform(), random.uniform(), random.uniform()))
    detail = SolidTexture(
      palette: [[0.55, 0.55, 0.55], [1, 1, 1], [1.25, 1.25, 1.25]], wavelength: 0.016, octaves: 4,
      seed: seed &+ 1)
    flower = Self.flower(&random)
  }

  package func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    let place = place(of: SIMD2(point.x, point.y))
    var color = paper
    // The edges are irregular by a millimeter.
    let solid = SIMD3(place.x, place.y, 0)
    let rough = 0.002 * (SolidTexture.noise(solid / 0.004, seed) - 0.5)
    let shade = detail.color(at: solid, footprint: footprint)
    for part in flower {
      let covered = coverage(part.distance(place) + rough, footprint)
      if covered > 0 { color += (part.color * shade - color) * covered }
    }
    let uneven = SolidTexture.noise(point / 0.5, seed &+ 2) + SolidTexture.noise(point / 0.06, seed)
    return color * (1 + unevenness * (uneven - 1))
  }

  /// A point of the wall relative to the middle of the cell that it is in.
  private func place(of point: SIMD2<Float>) -> SIMD2<Float> {
    let column = (point.x / period.x).rounded(.down)
    let isShifted = column.truncatingRemainder(dividingBy: 2) != 0
    let height = point.y / period.y + (isShifted ? 0.5 : 0)
    return SIMD2(point.x / period.x - column - 0.5, height - height.rounded(.down) - 0.5) * period
  }

  // MARK: The flower

  /// Its parts from back to front: stem, leaves, petals, core and buds.
  private static func flower(_ random: inout SeededGenerator) -> [Ellipse] {
    let middle = SIMD2<Float>(spread(&random, 0.011), 0.01 + spread(&random, 0.006))
    let start = SIMD2<Float>(spread(&random, 0.03), -0.072)
    let green = SIMD3<Float>([0.05, 0.13, 0.05] + 0.06 * random.uniform())
    var parts = stem(from: start, to: middle, bend: spread(&random, 0.02), green)
    for side in [-1, 1, random.uniform() < 0.5 ? -1 : 1] as [Float] {
      let t = Float(0.2 + 0.5 * random.uniform())
      let angle = side * Float(0.4 + 0.9 * random.uniform())
      let direction = SIMD2(sin(angle), cos(angle))
      let half = SIMD2(0.022, 0.008) * Float(0.8 + 0.6 * random.uniform())
      parts.append(
        Ellipse(
          center: start + (middle - start) * t + direction * half.x, direction: direction,
          halfAxes: half, color: green * Float(0.7 + 1.3 * random.uniform())))
    }
    let color = SIMD3<Float>(
      [0.25 + 0.5 * random.uniform(), 0.04 + 0.2 * random.uniform(), 0.05 + 0.4 * random.uniform()])
    parts += petals(
      around: middle, radius: 0.029, count: 6 + Int(3 * random.uniform()), color, &random)
    parts += petals(around: middle, radius: 0.017, count: 5, color * 0.5, &random)
    parts.append(dot(at: middle, radius: 0.009, [0.6, 0.42, 0.06]))
    for _ in 0..<6 {
      let offset = SIMD2<Float>(spread(&random, 0.007), spread(&random, 0.007))
      parts.append(dot(at: middle + offset, radius: 0.0014, [0.06, 0.03, 0.02]))
    }
    for _ in 0..<4 {
      let place = SIMD2<Float>(spread(&random, 0.066), spread(&random, 0.07))
      parts.append(
        dot(at: place, radius: Float(0.0025 + 0.0035 * random.uniform()), color * 0.8))
    }
    return parts
  }

  private static func stem(
    from start: SIMD2<Float>, to end: SIMD2<Float>, bend: Float, _ color: SIMD3<Float>
  ) -> [Ellipse] {
    (0..<20).map { index in
      let t = (Float(index) + 0.5) / 20
      let center = start + (end - start) * t + SIMD2(bend * sin(.pi * t), 0)
      return dot(at: center, radius: 0.0032 - 0.0012 * t, color)
    }
  }

  /// Petals of different lengths, widths and shades, at irregular angles.
  private static func petals(
    around middle: SIMD2<Float>, radius: Float, count: Int, _ color: SIMD3<Float>,
    _ random: inout SeededGenerator
  ) -> [Ellipse] {
    let first = 2 * Float.pi * Float(random.uniform())
    return (0..<count).map { index in
      let angle = first + 2 * .pi * (Float(index) + spread(&random, 0.3)) / Float(count)
      let direction = SIMD2(cos(angle), sin(angle))
      let length = radius * (1 + spread(&random, 0.25))
      let tint = SIMD3<Float>([
        0.7 + 0.7 * random.uniform(), 0.7 + 0.7 * random.uniform(), 0.7 + 0.7 * random.uniform(),
      ])
      return Ellipse(
        center: middle + direction * length, direction: direction,
        halfAxes: SIMD2(0.75, 2.2 / Float(count) * (1 + spread(&random, 0.25))) * length,
        color: pointwiseMin(color * tint, SIMD3(repeating: 0.9)))
    }
  }

  private static func dot(
    at center: SIMD2<Float>, radius: Float, _ color: SIMD3<Float>
  ) -> Ellipse {
    Ellipse(
      center: center, direction: [1, 0], halfAxes: SIMD2(repeating: radius), color: color)
  }

  /// Between −`size` and `size`.
  private static func spread(_ random: inout SeededGenerator, _ size: Double) -> Float {
    Float((2 * random.uniform() - 1) * size)
  }
}
