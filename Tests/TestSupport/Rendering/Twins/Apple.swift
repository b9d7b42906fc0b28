import Foundation
import SceneModel

/// An apple with a stem. All values were chosen.
struct Apple {
  private let radius: Float
  private let dimple: SIMD2<Float>
  private let bottom: SIMD2<Float>
  private let flatness: Float
  private let lobes: SIMD2<Float>
  private let uneven: Float
  private let stemTip: SIMD3<Float>
  private let seed: UInt32
  private let skin: AppleSkin

  init(_ random: inout TwinRandom) {
    radius = random.value(0.038, 0.043)
    // Depth relative to the radius, and width as a polar angle.
    dimple = [random.value(0.34, 0.44), random.value(0.3, 0.4)]
    bottom = [random.value(0.14, 0.2), random.value(0.3, 0.4)]
    flatness = random.value(0.9, 1)
    lobes = [random.value(0.012, 0.03), random.value(0, 6)]
    uneven = random.value(0.05, 0.1)
    stemTip = [
      random.value(-0.008, 0.008), random.value(0.006, 0.012), random.value(-0.008, 0.008),
    ]
    seed = random.number()
    skin = AppleSkin(&random)
  }

  var model: TwinObject.Model {
    let reach = 1.3 * radius
    let (flesh, stem) = (flesh, stem)
    let wood = SolidTexture(
      palette: [[0.05, 0.03, 0.02], [0.2, 0.12, 0.06], [0.36, 0.25, 0.13]], wavelength: 0.003,
      octaves: 4, seed: seed &+ 9)
    return TwinObject.Model(
      solid: flesh.union(stem, rounding: 0.0015),
      texture: PaintedParts(parts: [.init(flesh, skin), .init(stem, wood)]),
      // Lobes reach below the height that `center` supposes.
      low: [-reach, -0.3 * radius, -reach], high: [reach, 2.9 * radius, reach], cell: 0.0005)
  }

  private var center: SIMD3<Float> { [0, 0.9 * radius * flatness, 0] }

  /// Star-shaped: each direction from its middle has a radius.
  private var flesh: Solid {
    let shape = self
    return Solid { p in
      let offset = p - shape.center
      let distance = max(offset.length, 1e-6)
      // Its middle is inside of the dimple's bottom, so that the radius varies slowly everywhere.
      return 0.5 * (distance - shape.radius(toward: offset / distance))
    }
  }

  private func radius(toward direction: SIMD3<Float>) -> Float {
    let polar = acos(min(max(direction.y, -1), 1))
    let azimuth = atan2(direction.x, direction.z)
    func bell(_ x: Float) -> Float { exp(-x * x) }
    let fromBottom = (Float.pi - polar) / bottom.y
    let sides = sin(polar)
    // Broadest above the middle, with five lobes around the lower end.
    let shoulders = 0.07 * cos(polar) * sides
    let lobe = lobes.x * cos(5 * azimuth + lobes.y) * (0.3 + 0.7 * bell(fromBottom / 2.5)) * sides
    let noise = SolidTexture.noise(direction * 1.3 + 7, seed) - 0.5
    let height = flatness + (1 - flatness) * sides
    return radius
      * (height + shoulders + lobe + uneven * noise - dimple.x * bell(polar / dimple.y)
        - bottom.x * bell(fromBottom))
  }

  private var stem: Solid {
    let base = center + SIMD3(0, radius(toward: [0, 1, 0]) - 0.003, 0)
    let middle = base + SIMD3(0.3 * stemTip.x, 0.011, 0.3 * stemTip.z)
    let tip = middle + stemTip
    return .union(
      [
        .cone(from: base, to: middle, radii: [0.0016, 0.0012]),
        .cone(from: middle, to: tip, radii: [0.0012, 0.0019]),
      ], rounding: 0.001)
  }
}

/// Red over yellow, streaked from stem to base, with pale speckles. All values were chosen.
private struct AppleSkin: SurfaceTexture {
  private let ground: SIMD3<Float>
  private let blush: SIMD3<Float>
  private let sunny: SIMD3<Float>
  private let extent: Float
  private let seed: UInt32

  init(_ random: inout TwinRandom) {
    ground = [random.value(0.42, 0.58), random.value(0.4, 0.5), random.value(0.06, 0.14)]
    blush = [random.value(0.38, 0.52), random.value(0.03, 0.09), random.value(0.03, 0.06)]
    sunny = SIMD3(random.value(-1, 1), random.value(0, 0.8), random.value(-1, 1)).normalized
    extent = random.value(-0.2, 0.25)
    seed = random.number()
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    let offset = point - SIMD3(0, 0.036, 0)
    let direction = offset.normalized
    let azimuth = atan2(direction.x, direction.z)
    // Streaks are lines of constant azimuth, on a circle so that they have no seam.
    let around = SIMD3(cos(azimuth), 0.25 * direction.y, sin(azimuth))
    func noise(_ p: SIMD3<Float>, _ number: UInt32) -> Float {
      SolidTexture.noise(p, seed &+ number) - 0.5
    }
    let streaks =
      0.9 * noise(around * 9, 1) + 0.8 * noise(around * 23, 2) + 0.5 * noise(around * 51, 3)
    let patches = noise(offset / 0.02, 4) + 0.5 * noise(offset / 0.008, 5)
    let redness = 0.5 + 0.75 * direction.dot(sunny) + extent + 0.45 * streaks + 0.5 * patches
    let t = min(max(redness, 0), 1)
    var color = ground + (blush - ground) * (t * t * (3 - 2 * t))
    let fine = 0.5 * noise(offset / 0.0022, 6) + 0.5 * noise(offset / 0.0009, 7)
    color *= 1 + 0.16 * fine * resolved(0.0009, 0.5 * footprint)
    return color + ([0.66, 0.55, 0.32] - color) * (0.55 * speckle(offset, footprint))
  }

  /// The fraction of a pixel that a speckle covers: at most one per cell of 2.6 mm.
  private func speckle(_ place: SIMD3<Float>, _ footprint: Float) -> Float {
    let pitch: Float = 0.0026
    let cell = (place / pitch).rounded(.down)
    func random(_ number: UInt32) -> Float { SolidTexture.noise(cell, seed &+ number) }
    let jitter = SIMD3(random(11), random(12), random(13)) - 0.5
    let size = 0.00022 + 0.0004 * random(14) * random(15)
    let center = (cell + 0.5 + 0.6 * jitter) * pitch
    return coverage((place - center).length - size, footprint) * resolved(size, 0.3 * footprint)
  }
}
