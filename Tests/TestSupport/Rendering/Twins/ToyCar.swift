import Foundation
import SceneModel

/// A toy car with sharp edges, wheels on visible axles, mirrors, bumpers and an antenna, which
/// faces +z. All values were chosen, for a car of 12 cm.
struct ToyCar {
  /// Half of width and length of the body.
  private let half: SIMD2<Float>
  /// Heights of the body's lower side, of the hood and of the roof.
  private let floor: Float
  private let hood: Float
  private let roof: Float
  /// The cabin from its back to its front at the height of the hood.
  private let cabin: SIMD2<Float>
  /// How far windshield and rear window lean, as horizontal per vertical distance.
  private let rake: SIMD2<Float>
  private let wheel: Float
  /// Places of the axles along z.
  private let axles: [Float]
  private let hasRack: Bool
  private let hasSpoiler: Bool
  private let spokes: Float
  private let paint: CarPaint
  private let trim: [SolidTexture]

  init(_ random: inout TwinRandom) {
    half = [random.value(0.021, 0.024), random.value(0.056, 0.061)]
    wheel = random.value(0.0105, 0.0125)
    floor = random.value(0.008, 0.01)
    hood = 2 * wheel + random.value(0.006, 0.009)
    roof = hood + random.value(0.013, 0.019)
    let back = random.value(-0.052, -0.03)
    cabin = [back, random.value(0.012, 0.024)]
    rake = [random.value(0.1, 0.7), random.value(0.5, 1.1)]
    axles = [random.value(-0.037, -0.033), random.value(0.033, 0.038)]
    hasRack = random.chance(0.5)
    hasSpoiler = !hasRack
    spokes = random.one(of: [5, 6, 7])
    paint = CarPaint(&random)
    trim = [[0.03, 0.07], [0.28, 0.6], [0.02, 0.05], [0.5, 0.75]].map { shades in
      SolidTexture(
        palette: shades.map { SIMD3(repeating: $0) }, wavelength: 0.004, octaves: 4,
        seed: random.number())
    }
  }

  var model: TwinObject.Model {
    let (rubber, metal, glass, lamp) = (trim[0], trim[1], trim[2], trim[3])
    let parts: [PaintedParts.Part] = [
      .init(bodywork, paint), .init(windows, glass), .init(.union(tires), rubber),
      .init(.union(hubs + axleRods), metal), .init(.union(metalParts), metal),
      .init(.union(lamps), lamp),
    ]
    return TwinObject.Model(
      solid: .union(
        [bodywork, windows] + tires + hubs + axleRods + metalParts + lamps),
      texture: PaintedParts(parts: parts), low: [-0.036, 0, -0.068], high: [0.036, 0.07, 0.068],
      cell: 0.0004)
  }

  // MARK: Body

  private var bodywork: Solid {
    let (middle, lift) = ((floor + hood) / 2, (hood - floor) / 2)
    let hull = Solid.box([0, middle, 0], [half.x, lift, half.y])
      // Hood and trunk slope down.
      .intersection(.below([0, hood, 0.015], normal: SIMD3(0, 1, 0.12).normalized))
      .intersection(.below([0, hood, -0.03], normal: SIMD3(0, 1, -0.06).normalized))
      .intersection(.below([0, hood, half.y - 0.006], normal: SIMD3(0, 0.5, 1).normalized))
      .intersection(.below([half.x, floor + 0.6 * lift, 0], normal: SIMD3(1, 0.12, 0).normalized))
      .intersection(
        .below([-half.x, floor + 0.6 * lift, 0], normal: SIMD3(-1, 0.12, 0).normalized))
    let arches = axles.map {
      Solid.cylinder(
        [0, wheel, $0], axis: 0, radius: wheel + 0.0022, halfHeight: 0.0075
      ).moved(by: RigidTransform(rotation: .identity, translation: [Double(half.x), 0, 0])).mirrored
    }
    let grooves = [cabin.y - 0.001, cabin.x + 0.004, (cabin.x + cabin.y) / 2].map {
      Solid.box([half.x, middle + 0.003, $0], [0.0012, lift * 0.8, 0.0005]).mirrored
    }
    var body = (arches + grooves).reduce(hull) { $0.subtracting($1) }
    let grille = (0..<4).map { row in
      Solid.box(
        [0, floor + 0.004 + 0.0022 * Float(row), half.y], [0.009, 0.0006, 0.0022])
    }
    body = grille.reduce(body) { $0.subtracting($1) }
    return .union([body, roofedCabin] + (hasSpoiler ? spoiler : []))
  }

  /// The cabin without its windows, which are set back by a millimeter.
  private var roofedCabin: Solid {
    let pillars = Solid.union([
      .box([0, roof, (cabin.x + cabin.y) / 2 - 0.002], [1, 1, 0.0014]),
      .box([0, roof, 0], [half.x * 0.66, 0.0028, 1]),
    ])
    let shell = wedge(inset: 0)
    let frame = shell.subtracting(opening(axis: 0)).subtracting(opening(axis: 2))
    return frame.union(shell.intersection(pillars))
  }

  private var windows: Solid { wedge(inset: 0.0011) }

  /// A hole through the cabin along an axis, smaller than the cabin by the width of its pillars.
  private func opening(axis: Int) -> Solid {
    let frame: Float = 0.0024
    let inner = wedge(inset: frame)
    return Solid { p in
      var q = p
      if axis == 0 { q.x = 0 } else { q.z = min(max(p.z, -0.004), 0.002) }
      return inner.distance(q)
    }
  }

  /// The volume of the cabin, smaller by `inset` on all sides.
  private func wedge(inset: Float) -> Solid {
    let tumble: Float = 0.22
    let planes = [
      Solid.below([0, roof, 0], normal: [0, 1, 0]),
      .below([half.x - 0.001, hood, 0], normal: SIMD3(1, tumble, 0).normalized),
      .below([-half.x + 0.001, hood, 0], normal: SIMD3(-1, tumble, 0).normalized),
      .below([0, hood, cabin.y], normal: SIMD3(0, rake.y, 1).normalized),
      .below([0, hood, cabin.x], normal: SIMD3(0, rake.x, -1).normalized),
    ]
    let base = Solid.below([0, hood - 0.003, 0], normal: [0, -1, 0])
    return Solid { p in
      max(planes.map { $0.distance(p) }.max() ?? 0, base.distance(p)) + inset
    }
  }

  private var spoiler: [Solid] {
    let height = hood + 0.007
    let wing = Solid.box([0, height, -half.y + 0.004], [half.x - 0.001, 0.0009, 0.005])
    let struts = Solid.box([0.012, height - 0.005, -half.y + 0.005], [0.0009, 0.0055, 0.002])
    return [wing, struts.mirrored]
  }

  // MARK: Attachments

  private var wheelCenters: [SIMD3<Float>] { axles.map { [half.x - 0.0005, wheel, $0] } }

  private var tires: [Solid] {
    wheelCenters.map { center in
      let tread = Solid.cylinder(
        center, axis: 0, radius: wheel, halfHeight: 0.0038, rounding: 0.0008)
      let rim = Solid.cylinder(
        center + SIMD3(0.0038, 0, 0), axis: 0, radius: 0.64 * wheel, halfHeight: 0.0018)
      return tread.subtracting(rim).mirrored
    }
  }

  /// Spokes and a hub in each rim.
  private var hubs: [Solid] {
    wheelCenters.map { center in
      let (spokes, wheel) = (spokes, wheel)
      let star = Solid { p in
        let q = p - center
        let sector = 2 * Float.pi / spokes
        let angle = atan2(q.y, q.z)
        let local = angle - sector * (angle / sector).rounded()
        let distance = SIMD2(q.y, q.z).length
        let across = abs(distance * sin(local)) - 0.0011
        return max(across, distance - 0.68 * wheel, abs(q.x - 0.0022) - 0.0009)
      }
      let hub = Solid.cylinder(
        center + SIMD3(0.002, 0, 0), axis: 0, radius: 0.0026, halfHeight: 0.0022)
      return star.union(hub).mirrored
    }
  }

  private var axleRods: [Solid] {
    axles.map { .cylinder([0, wheel, $0], axis: 0, radius: 0.0012, halfHeight: half.x) }
  }

  private var metalParts: [Solid] {
    let bumpers = [half.y, -half.y].map { z -> Solid in
      let out = z > 0 ? Float(0.0025) : -0.0025
      let bar = Solid.rod(
        from: [-half.x + 0.001, floor + 0.003, z + out],
        to: [half.x - 0.001, floor + 0.003, z + out], radius: 0.0013)
      let mount = Solid.box([0.012, floor + 0.003, z + out / 2], [0.0012, 0.0009, 0.003])
      return bar.union(mount.mirrored)
    }
    let base = SIMD3(half.x - 0.003, hood + 0.001, cabin.y - 0.004)
    let mirror = Solid.rod(from: base, to: base + SIMD3(0.0055, 0.0025, 0), radius: 0.0007)
      .union(.box(base + SIMD3(0.0068, 0.0032, 0), [0.0022, 0.0017, 0.0008])).mirrored
    let antenna = Solid.rod(
      from: [-0.013, hood - 0.002, cabin.x - 0.002], to: [-0.014, roof + 0.012, cabin.x - 0.006],
      radius: 0.00075)
    return bumpers + [mirror, antenna] + (hasRack ? [rack] : [])
  }

  /// Two rails over the roof on four posts, with three rods across.
  private var rack: Solid {
    let (x, y) = (half.x * 0.55, roof + 0.004)
    let length = SIMD2(cabin.x + rake.x * 0.012 + 0.004, cabin.y - rake.y * 0.017 - 0.002)
    let rail = Solid.rod(from: [x, y, length.x], to: [x, y, length.y], radius: 0.0008)
    let posts = [0.12, 0.88].map { t -> Solid in
      let z = length.x + (length.y - length.x) * Float(t)
      return .rod(from: [x, roof - 0.001, z], to: [x, y, z], radius: 0.0008)
    }
    let rods = [0.1, 0.5, 0.9].map { t -> Solid in
      let z = length.x + (length.y - length.x) * Float(t)
      return .rod(from: [-x, y, z], to: [x, y, z], radius: 0.0007)
    }
    return .union([Solid.union([rail] + posts).mirrored] + rods)
  }

  private var lamps: [Solid] {
    let front = Solid.cylinder(
      [half.x - 0.006, (floor + hood) / 2 + 0.0015, half.y], axis: 2, radius: 0.0036,
      halfHeight: 0.0012)
    let back = Solid.box(
      [half.x - 0.005, (floor + hood) / 2 + 0.002, -half.y], [0.0032, 0.0016, 0.001])
    return [front.mirrored, back.mirrored]
  }
}
