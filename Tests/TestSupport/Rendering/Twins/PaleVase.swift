import Foundation
import SceneModel

/// A vase with an open mouth: a surface of revolution. All values were chosen.
struct PaleVase {
  private let height: Float
  /// Radii at the heights of `levels`.
  private let radii: [Float]
  private let levels: [Float] = [0, 0.05, 0.2, 0.42, 0.62, 0.8, 0.92, 1]
  private let wall: Float = 0.005
  private let depth: Float
  private let glaze: PaleGlaze

  init(_ random: inout TwinRandom) {
    height = random.value(0.22, 0.28)
    let base = random.value(0.17, 0.22)
    let belly = random.value(0.3, 0.38)
    let shoulder = random.value(0.24, 0.36)
    let neck = random.value(0.12, 0.18)
    let lip = neck + random.value(0.02, 0.07)
    let relative = [
      base, 0.96 * base, 0.55 * (base + belly), belly, shoulder, 0.4 * shoulder + 0.6 * neck, neck,
      lip,
    ]
    let height = height
    radii = relative.map { $0 * height }
    depth = random.value(0.35, 0.6)
    glaze = PaleGlaze(height: height, &random)
  }

  var model: TwinObject.Model {
    let reach = (radii.max() ?? 0.1) * 1.05
    return TwinObject.Model(
      solid: solid, texture: glaze, low: [-reach, 0, -reach], high: [reach, height, reach],
      cell: 0.0011)
  }

  private var solid: Solid {
    let shape = self
    func turned(inward: Float) -> Solid {
      Solid { p in
        let (radius, slope) = shape.radius(at: p.y / shape.height)
        let across = (p.x * p.x + p.z * p.z).squareRoot()
        let steep = slope / shape.height
        return (across - radius) / (1 + steep * steep).squareRoot() + inward
      }
    }
    let body = turned(inward: 0)
      .intersection(.below([0, height, 0], normal: [0, 1, 0]), rounding: 0.006)
      .intersection(.below([0, 0, 0], normal: [0, -1, 0]), rounding: 0.005)
    let floor = Solid.below([0, height * (1 - depth), 0], normal: [0, -1, 0])
    return body.subtracting(
      turned(inward: wall).intersection(floor, rounding: 0.02), rounding: 0.004)
  }

  /// The radius and its derivative at a relative height, as a Catmull–Rom spline.
  private func radius(at h: Float) -> (Float, Float) {
    let last = levels.count - 1
    let t = min(max(h, 0), 1)
    let index = min(levels.lastIndex { $0 <= t } ?? 0, last - 1)
    func slope(_ i: Int) -> Float {
      let (a, b) = (max(0, i - 1), min(last, i + 1))
      return (radii[b] - radii[a]) / (levels[b] - levels[a])
    }
    let width = levels[index + 1] - levels[index]
    let s = (t - levels[index]) / width
    let (p, q) = (radii[index], radii[index + 1])
    let (m, n) = (slope(index) * width, slope(index + 1) * width)
    let (a, b) = (2 * (p - q) + m + n, 3 * (q - p) - 2 * m - n)
    let value = ((a * s + b) * s + m) * s + p
    return (value, (3 * a * s * s + 2 * b * s + m) / width)
  }
}

/// A pale glaze that is slightly mottled, with faint rings and leaves. All values were chosen.
private struct PaleGlaze: SurfaceTexture {
  private let base: SIMD3<Float>
  private let ink: SIMD3<Float>
  private let rings: [SIMD2<Float>]
  private let leafRow: SIMD2<Float>
  private let leaves: Float
  private let lean: Float
  private let mottling: Float
  private let seed: UInt32

  init(height: Float, _ random: inout TwinRandom) {
    let lightness = random.value(0.56, 0.64)
    base = lightness * SIMD3(1, random.value(0.95, 0.99), random.value(0.86, 0.95))
    ink = random.color(1, saturation: 0.06)
    // Height and width of each.
    rings = [0.3, 0.66, 0.7, 0.87].map {
      [($0 + random.value(-0.03, 0.03)) * height, random.value(0.002, 0.006)]
    }
    leafRow = [random.value(0.44, 0.54) * height, random.value(0.05, 0.07) * height]
    leaves = random.value(9, 16).rounded()
    lean = random.value(-0.8, 0.8)
    mottling = random.value(0.09, 0.105)
    seed = random.number()
  }

  func color(at point: SIMD3<Float>, footprint: Float) -> SIMD3<Float> {
    func noise(_ length: Float, _ number: UInt32) -> Float {
      let visible = resolved(length, footprint)
      return visible * (SolidTexture.noise(point / length, seed &+ number) - 0.5)
    }
    let clouds = 0.7 * noise(0.05, 1) + 0.5 * noise(0.017, 2)
    let fine = 1 * noise(0.0058, 3) + 1.1 * noise(0.0027, 4) + 0.9 * noise(0.0014, 5)
    let decoration = 0.035 * decoration(at: point, footprint)
    return base * (1 + mottling * (clouds + fine)) * (1 - decoration * ink)
  }

  /// The fraction of a pixel that rings and leaves cover.
  private func decoration(at point: SIMD3<Float>, _ footprint: Float) -> Float {
    let azimuth = atan2(point.x, point.z)
    let wave = 0.0008 * SolidTexture.noise(SIMD3(4 * cos(azimuth), 4 * sin(azimuth), 0), seed)
    var covered = rings.reduce(Float(0)) {
      max($0, coverage(abs(point.y + wave - $1.x) - $1.y / 2, footprint))
    }
    let up = (point.y - leafRow.x) / leafRow.y
    guard abs(up) < 1 else { return covered }
    let turn = azimuth / (2 * .pi) * leaves + 0.25 * lean * up
    let across = abs(turn - turn.rounded()) * 2
    let radius = (point.x * point.x + point.z * point.z).squareRoot()
    let distance = (across - 0.55 * (1 - up * up)) * .pi * radius / leaves
    covered = max(covered, coverage(distance, footprint))
    return covered
  }
}
