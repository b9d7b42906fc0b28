import Foundation
import SceneModel

/// A draped figure on a plinth, 1 m high. All values were chosen, in meters.
struct MarbleStatue {
  /// How the robe is folded.
  private struct Folds {
    var count: [Float]
    var phase: [Float]
    var twist: Float
    var depth: Float
  }

  private let folds: Folds
  private let plinth: [Solid]
  private var limbs: [Solid] = []
  private let hem: Float
  private let waist: SIMD3<Float>
  private let seed: UInt32
  private let marble: Marble

  init(_ random: inout TwinRandom) {
    folds = Folds(
      count: [random.value(5, 8).rounded(), random.value(11, 15).rounded()],
      phase: [random.value(0, 6), random.value(0, 6)], twist: random.value(-5, 5),
      depth: random.value(0.016, 0.024))
    hem = random.value(0.15, 0.18)
    waist = [random.value(-0.02, 0.02), 0.56, random.value(-0.01, 0.02)]
    let side = random.value(0.19, 0.21)
    plinth = [
      .box([0, 0.03, 0], [side, 0.03, side], rounding: 0.004),
      .box([0, 0.09, 0], [side - 0.025, 0.05, side - 0.025], rounding: 0.003),
      .box([0, 0.14, 0], [side - 0.008, 0.012, side - 0.008], rounding: 0.006),
    ]
    seed = random.number()
    marble = Marble(&random)
    let neck = waist + SIMD3(random.value(-0.02, 0.02), 0.24, random.value(-0.01, 0.015))
    addTorso(neck, &random)
    addHead(neck + SIMD3(random.value(-0.015, 0.015), 0.095, 0.012), &random)
    addArms(neck, &random)
  }

  var model: TwinObject.Model {
    let seed = seed
    let body = Solid.union([robe] + limbs, rounding: 0.02).displaced { p in
      0.005 * (SolidTexture.noise(p / 0.06, seed) - 0.5)
        + 0.002 * (SolidTexture.noise(p / 0.018, seed &+ 1) - 0.5)
    }
    let solid = Solid.union(plinth, rounding: 0.006).union(body, rounding: 0.012)
      .intersection(.below(.zero, normal: [0, -1, 0]))
    return TwinObject.Model(
      solid: solid, texture: marble, low: [-0.36, 0, -0.36], high: [0.36, 1.12, 0.36],
      cell: 0.0036)
  }

  /// From the plinth to the waist, with folds that fade upward.
  private var robe: Solid {
    let (folds, hem, waist) = (folds, hem, waist)
    return Solid { p in
      let t = min(max((p.y - 0.14) / (waist.y - 0.14), 0), 1)
      let axis = waist * t
      let offset = SIMD2(p.x - axis.x, (p.z - axis.z) * 1.18)
      let angle = atan2(offset.x, offset.y)
      let twisted = angle + folds.twist * (p.y - 0.14) * 0.25
      let wave =
        sin(folds.count[0] * twisted + folds.phase[0])
        + 0.6 * sin(folds.count[1] * twisted + folds.phase[1] + 9 * p.y)
      let taper = 1 - t * t * (3 - 2 * t)
      let radius = 0.088 + (hem - 0.088) * taper + folds.depth * wave * (0.25 + 0.75 * (1 - t))
      let side = 0.62 * (offset.length - radius)
      return max(side, 0.14 - p.y, p.y - waist.y - 0.03)
    }
  }

  private mutating func addTorso(_ neck: SIMD3<Float>, _ random: inout TwinRandom) {
    let chest = waist + (neck - waist) * 0.55
    limbs.append(.cone(from: waist, to: chest, radii: [0.085, 0.1]))
    limbs.append(.ellipsoid(chest + SIMD3(0, 0.01, 0.015), [0.115, 0.1, 0.085]))
    limbs.append(
      .cone(from: neck - SIMD3(0, 0.05, 0), to: neck + SIMD3(0, 0.06, 0.008), radii: [0.05, 0.036]))
    // A belt, and a sash from a shoulder to the hip.
    limbs.append(
      .torus(waist + SIMD3(0, 0.01, 0), axis: [0, 1, 0], radius: 0.092, thickness: 0.014))
    let lean: Float = random.chance(0.5) ? 1 : -1
    for index in 0..<3 {
      let shift = Float(index) * 0.026
      limbs.append(
        .torus(
          chest + SIMD3(lean * (0.02 - 0.5 * shift), 0.02 - shift, 0),
          axis: SIMD3(lean * 0.75, 1, 0.1).normalized, radius: 0.108, thickness: 0.013))
    }
  }

  private mutating func addHead(_ head: SIMD3<Float>, _ random: inout TwinRandom) {
    limbs.append(.ellipsoid(head, [0.056, 0.074, 0.064]))
    limbs.append(.ellipsoid(head + SIMD3(0, -0.03, 0.03), [0.036, 0.04, 0.036]))
    limbs.append(
      .cone(
        from: head + SIMD3(0, 0.022, 0.06), to: head + SIMD3(0, -0.008, 0.076),
        radii: [0.007, 0.011]))
    limbs.append(
      .torus(
        head + SIMD3(0, 0.035, -0.005), axis: SIMD3(0, 1, 0.35).normalized, radius: 0.058,
        thickness: 0.011))
    limbs.append(
      .ball(head + SIMD3(0, random.value(-0.02, 0.05), -0.075), random.value(0.026, 0.036)))
    for _ in 0..<14 {
      let direction = SIMD3(random.value(-1, 1), random.value(0.1, 1), random.value(-1, 0.2))
        .normalized
      limbs.append(.ball(head + direction * SIMD3(0.056, 0.07, 0.062), random.value(0.013, 0.02)))
    }
  }

  private mutating func addArms(_ neck: SIMD3<Float>, _ random: inout TwinRandom) {
    let raised: Float = random.chance(0.5) ? 1 : -1
    for side in [Float(-1), 1] {
      let shoulder = neck + SIMD3(side * 0.11, -0.045, 0)
      limbs.append(.cone(from: neck - SIMD3(0, 0.03, 0), to: shoulder, radii: [0.046, 0.05]))
      let isRaised = side == raised
      let elbow =
        shoulder
        + (isRaised
          ? SIMD3(side * random.value(0.1, 0.13), random.value(-0.06, 0.02), 0.05)
          : SIMD3(side * random.value(0.05, 0.08), -0.16, -0.01))
      let hand =
        elbow
        + (isRaised
          ? SIMD3(side * random.value(-0.03, 0.04), random.value(0.1, 0.14), 0.06)
          : SIMD3(side * -0.01, -0.06, random.value(0.1, 0.13)))
      limbs.append(.cone(from: shoulder, to: elbow, radii: [0.047, 0.036]))
      limbs.append(.cone(from: elbow, to: hand, radii: [0.036, 0.025]))
      limbs.append(.ellipsoid(hand + SIMD3(0, isRaised ? 0.02 : 0, 0.01), [0.024, 0.032, 0.024]))
      if isRaised {
        limbs.append(.ball(hand + SIMD3(0, 0.065, 0.012), random.value(0.032, 0.042)))
      } else {
        // A jug.
        let jug = hand + SIMD3(side * 0.01, -0.05, 0.035)
        limbs.append(.ellipsoid(jug, [0.045, 0.06, 0.045]))
        limbs.append(
          .torus(jug + SIMD3(0, 0.06, 0), axis: [0, 1, 0], radius: 0.025, thickness: 0.009))
      }
    }
  }
}

/// Pale stone with clouds and veins of low contrast. All values were chosen.
private struct Marble: SurfaceTexture {
  private let base: SIMD3<Float>
  private let vein: SIMD3<Float>
  private let tilt: SIMD3<Float>
  private let strength: Float
  private let seed: UInt32

  init(_ random: inout TwinRandom) {
    base = random.value(0.62, 0.7) * SIMD3(1, random.value(0.96, 0.99), random.value(0.9, 0.96))
    vein = random.color(1, saturation: 0.1)
    tilt = random.vector(1).normalized
    strength = random.value(0.16, 0.22)
    seed = random.number()
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    func noise(_ length: Float, _ number: UInt32) -> Float {
      let visible = resolved(length, footprint)
      return visible > 0
        ? visible * (SolidTexture.noise(point / length, seed &+ number) - 0.5) : 0
    }
    let warp = SIMD3(noise(0.16, 1), noise(0.11, 2), noise(0.13, 3)) * 0.12
    func veins(_ length: Float, _ number: UInt32) -> Float {
      let place = (point + warp + tilt * (0.6 * (point.dot(tilt)))) / length
      let ridge = abs(SolidTexture.noise(place, seed &+ number) - 0.5)
      return max(0, 1 - ridge / 0.05)
    }
    let lines = 0.65 * veins(0.13, 4) + 0.4 * veins(0.05, 5)
    let clouds = 0.1 * noise(0.09, 6) + 0.08 * noise(0.03, 7)
    let grain = 0.075 * noise(0.012, 8) + 0.07 * noise(0.0055, 9)
    return base * (1 + clouds + grain) * (1 - strength * min(1, lines) * vein)
  }
}
