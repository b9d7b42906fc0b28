import Foundation
import SceneModel

/// A small painted figure with a hat or ears on a round base, holding a staff and a ball. All
/// values were chosen, for a figure of height 1.
struct Statuette {
  private static let height: Float = 0.15

  private struct Part {
    var solid: Solid
    var paint: Int
  }

  private var parts: [Part] = []
  private let paints: [any SurfaceTexture]
  private let seed: UInt32

  init(_ random: inout TwinRandom) {
    seed = random.number()
    paints = (0..<6).map { _ in Self.paint(&random) }
    let hip = SIMD3(random.value(-0.03, 0.03), 0.31, random.value(-0.02, 0.03))
    let neck = hip + SIMD3(random.value(-0.05, 0.05), 0.22, random.value(-0.03, 0.04))
    addBase(&random)
    addBody(hip, neck, &random)
    let head = neck + SIMD3(random.value(-0.03, 0.03), 0.11, random.value(0, 0.03))
    addHead(head, &random)
    addArms(neck, &random)
  }

  var model: TwinObject.Model {
    let (height, seed) = (Self.height, seed)
    let folded = parts.map(\.solid)
    let figure = Solid.union(folded, rounding: 0.022).displaced { p in
      let coarse = SolidTexture.noise(p / 0.06, seed) - 0.5
      let fine = SolidTexture.noise(p / 0.022, seed &+ 1) - 0.5
      // Not at the bottom, which is plane.
      return min(1, p.y / 0.04) * (0.014 * coarse + 0.006 * fine)
    }.intersection(.below(.zero, normal: [0, -1, 0]))
    let painted = PaintedParts(parts: parts.map { .init($0.solid, paints[$0.paint]) })
    return TwinObject.Model(
      solid: Solid { height * figure.distance($0 / height) },
      texture: ScaledTexture(texture: painted, scale: height),
      low: SIMD3(-0.34, 0, -0.34) * height, high: SIMD3(0.34, 1.12, 0.34) * height, cell: 0.00068)
  }

  /// Mottled with fine strokes, with colors around a random one.
  private static func paint(_ random: inout TwinRandom) -> SolidTexture {
    var palette = random.tones([0.05, 0.2, 0.36, 0.14, 0.6], saturation: 0.6)
    palette[random.one(of: [1, 2, 3])] = random.color(0.3, saturation: 0.6)
    return SolidTexture(
      palette: palette, wavelength: random.value(0.12, 0.25), octaves: 7, seed: random.number(),
      contrast: 1.9)
  }

  private mutating func add(_ solid: Solid, _ paint: Int) {
    parts.append(Part(solid: solid, paint: paint))
  }

  private mutating func addBase(_ random: inout TwinRandom) {
    let radius = random.value(0.22, 0.27)
    add(
      .cylinder([0, 0.03, 0], axis: 1, radius: radius, halfHeight: 0.04, rounding: 0.015), 0)
    for _ in 0..<3 {
      let angle = random.value(0, 2 * Float.pi)
      let place = SIMD3(sin(angle), 0, cos(angle)) * (0.8 * radius)
      add(
        .ellipsoid(place + SIMD3(0, 0.07, 0), [0.04, random.value(0.03, 0.06), 0.035]), 0)
    }
    for side in [Float(-1), 1] {
      let place = SIMD3(side * 0.08, 0.1, random.value(0.02, 0.09))
      add(.ellipsoid(place, [0.055, 0.045, 0.085]), 5)
    }
  }

  private mutating func addBody(
    _ hip: SIMD3<Float>, _ neck: SIMD3<Float>, _ random: inout TwinRandom
  ) {
    let width = random.value(0.13, 0.17)
    add(.cone(from: hip - SIMD3(0, 0.1, 0), to: neck, radii: [width, 0.09]), 1)
    add(.ellipsoid(hip + SIMD3(0, 0.0, 0.05), [0.85 * width, 0.13, 0.11]), 1)
    add(
      .torus(
        hip + SIMD3(0, random.value(-0.02, 0.04), 0), axis: SIMD3(0.1, 1, 0.05).normalized,
        radius: width * 0.97, thickness: 0.02), 3)
    // A bundle on its back.
    add(
      .ellipsoid(
        hip + SIMD3(random.value(-0.05, 0.05), 0.13, -0.13), [0.1, random.value(0.08, 0.12), 0.07]),
      4)
  }

  private mutating func addHead(_ head: SIMD3<Float>, _ random: inout TwinRandom) {
    let size = random.value(0.1, 0.12)
    add(.ellipsoid(head, [size, 1.08 * size, size]), 2)
    add(.ball(head + SIMD3(random.value(-0.02, 0.02), -0.01, size), random.value(0.022, 0.034)), 2)
    let top = head + SIMD3(0, 0.06, -0.01)
    if random.chance(0.5) {
      let tip =
        top + SIMD3(random.value(-0.1, 0.1), random.value(0.22, 0.28), random.value(-0.1, 0.02))
      add(.cone(from: top, to: tip, radii: [0.1, 0.022]), 3)
      add(
        .torus(top, axis: SIMD3(0, 1, 0.15).normalized, radius: 0.12, thickness: 0.024), 3)
    } else {
      for side in [Float(-1), 1] {
        let tip = top + SIMD3(side * random.value(0.06, 0.14), random.value(0.16, 0.24), -0.02)
        add(.cone(from: top + SIMD3(side * 0.055, 0, 0), to: tip, radii: [0.036, 0.024]), 2)
      }
      add(.ellipsoid(top + SIMD3(0, 0.03, -0.03), [0.08, 0.05, 0.08]), 4)
    }
    if random.chance(0.6) {
      add(.ellipsoid(head + SIMD3(0, -0.1, 0.07), [0.07, random.value(0.07, 0.12), 0.05]), 5)
    }
  }

  private mutating func addArms(_ neck: SIMD3<Float>, _ random: inout TwinRandom) {
    let staffSide: Float = random.chance(0.5) ? 1 : -1
    for side in [Float(-1), 1] {
      let shoulder = neck + SIMD3(side * 0.1, -0.03, 0)
      let elbow =
        shoulder + SIMD3(side * random.value(0.06, 0.09), random.value(-0.14, -0.08), 0.01)
      let hand =
        elbow
        + SIMD3(side * random.value(-0.03, 0.04), random.value(0, 0.1), random.value(0.09, 0.12))
      add(.cone(from: shoulder, to: elbow, radii: [0.052, 0.044]), 1)
      add(.cone(from: elbow, to: hand, radii: [0.044, 0.032]), 1)
      add(.ball(hand, 0.037), 2)
      if side == staffSide {
        let base = SIMD3(hand.x + side * 0.01, 0.05, hand.z)
        add(
          .rod(
            from: base, to: SIMD3(hand.x, random.value(0.72, 0.85), hand.z - 0.01), radius: 0.015),
          4)
      } else {
        add(.ball(hand + SIMD3(0, 0.05, 0.02), random.value(0.045, 0.06)), 3)
      }
    }
  }
}
