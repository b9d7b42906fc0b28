import Foundation
import SceneModel

/// Objects a few millimeters thick on a base of 24 × 18 cm: some close to a plate behind them, some
/// far in front of the table.
struct ThinObjects {
  let fineness: Double

  var mesh: Mesh {
    var mesh = Mesh.box(center: [0, 0.006, 0], halfSize: [0.12, 0.006, 0.09], cells: cells(60))
    mesh.append(plate)
    for part in rods + [wire] + mug + plant { mesh.append(part) }
    return mesh
  }

  private func cells(_ count: Int) -> Int { max(4, Int(Double(count) * fineness)) }

  private var plate: Mesh {
    .box(center: [-0.02, 0.095, -0.055], halfSize: [0.055, 0.085, 0.001], cells: cells(60))
  }

  /// Three rods 15 mm in front of the plate and four leaning free-standing ones.
  private var rods: [Mesh] {
    let before = [(-0.055, 0.001), (-0.03, 0.0015), (-0.005, 0.002)].map { x, radius in
      rod(from: [x, 0.01, -0.04], to: [x, 0.2, -0.04], radius)
    }
    let free = [0.001, 0.0015, 0.00225, 0.003].enumerated().map { index, radius in
      let t = Double(index)
      return rod(
        from: [0.055 + 0.015 * t, 0.01, -0.05 + 0.02 * t],
        to: [0.045 + 0.018 * t, 0.25 - 0.02 * t, -0.075 + 0.035 * t], radius)
    }
    return before + free
  }

  private func rod(from a: SIMD3<Double>, to b: SIMD3<Double>, _ radius: Double) -> Mesh {
    .rod(from: a, to: b, radius: radius, columns: cells(24), rows: cells(120))
  }

  /// A wire of 3 mm, bent to a helix of one and a half turns.
  private var wire: Mesh {
    .tube(
      along: { t in
        let angle = 3 * .pi * t
        return SIMD3(0.01 + 0.03 * cos(angle), 0.008 + 0.14 * t, 0.03 + 0.03 * sin(angle))
      }, side: [0, 1, 0], halfAxes: SIMD2(repeating: 0.0015), length: 0.31, columns: cells(24),
      rows: cells(300))
  }

  /// A closed cylinder with a handle of 5 mm.
  private var mug: [Mesh] {
    let body = Mesh.turned(
      [
        [0.024, 0.01], [0.026, 0.05], [0.026, 0.088], [0.024, 0.093], [0.012, 0.094], [0, 0.094],
      ],
      columns: cells(160), rows: cells(160)
    ).placed(at: [-0.07, 0, 0.04])
    let handle = Mesh.tube(
      along: { t in
        let angle = .pi * (t - 0.5)
        return SIMD3(-0.094 - 0.028 * cos(angle), 0.052 + 0.03 * sin(angle), 0.04)
      }, side: [0, 0, 1], halfAxes: SIMD2(repeating: 0.0025), length: 0.092, columns: cells(24),
      rows: cells(160))
    return [body, handle]
  }

  /// A stalk with leaves 2 mm thick.
  private var plant: [Mesh] {
    let bottom = SIMD3(0.075, 0.01, 0.055)
    let stalk = rod(from: bottom, to: bottom + SIMD3(0, 0.17, 0), 0.002)
    return [stalk]
      + (0..<6).map { index in
        let azimuth = 2.4 * Double(index)
        let out = SIMD3(cos(azimuth), 0, sin(azimuth))
        let start = bottom + SIMD3(0, 0.05 + 0.022 * Double(index), 0)
        return .tube(
          along: { t in start + out * (0.05 * t) + SIMD3(0, 0.03 * t - 0.025 * t * t, 0) },
          side: [0, 1, 0], halfAxes: [0.014, 0.001], length: 0.055, columns: cells(48),
          rows: cells(100), widening: { 0.1 + 0.9 * sin(.pi * $0) })
      }
  }
}
