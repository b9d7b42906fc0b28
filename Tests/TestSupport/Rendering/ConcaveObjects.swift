import Foundation
import SceneModel

/// Concave objects on a base of 28 × 22 cm.
struct ConcaveObjects {
  let fineness: Double

  var mesh: Mesh {
    var mesh = box([0, 0.005, 0], [0.14, 0.005, 0.11])
    for part in corner + ribs + arch + [bowl, vase, column] { mesh.append(part) }
    return mesh
  }

  private func cells(_ count: Int) -> Int { max(4, Int(Double(count) * fineness)) }

  private func box(_ center: SIMD3<Double>, _ halfSize: SIMD3<Double>) -> Mesh {
    .box(center: center, halfSize: halfSize, cells: cells(50))
  }

  /// A bowl 13 cm wide and 6 cm deep with a 6 mm wall.
  private var bowl: Mesh {
    Mesh.turned(
      [
        [0.028, 0], [0.045, 0.012], [0.059, 0.034], [0.065, 0.06], [0.0655, 0.066],
        [0.062, 0.068], [0.0585, 0.063], [0.053, 0.038], [0.040, 0.018], [0.022, 0.009],
        [0, 0.007],
      ], columns: cells(280), rows: cells(300)
    ).placed(at: [-0.065, 0.009, 0.038])
  }

  /// A vase as deep as its mouth is wide.
  private var vase: Mesh {
    Mesh.turned(
      [
        [0.032, 0], [0.038, 0.02], [0.036, 0.05], [0.033, 0.075], [0.038, 0.092], [0.0385, 0.096],
        [0.0355, 0.096], [0.029, 0.076], [0.031, 0.05], [0.032, 0.034], [0.024, 0.027], [0, 0.026],
      ], columns: cells(240), rows: cells(300)
    ).placed(at: [0.045, 0.009, 0.06])
  }

  /// A column with flutes 8 mm deep.
  private var column: Mesh {
    Mesh.turned(
      [[0.022, 0], [0.022, 0.05], [0.022, 0.1], [0.021, 0.14], [0.012, 0.142], [0, 0.142]],
      columns: cells(320), rows: cells(160),
      fluting: { 1 - 0.36 * pow(abs(sin(4 * $0)), 0.7) }
    ).placed(at: [0.115, 0.009, 0.04])
  }

  /// Two walls at a right angle.
  private var corner: [Mesh] {
    [
      box([-0.13, 0.065, -0.05], [0.004, 0.06, 0.05]),
      box([-0.076, 0.065, -0.1], [0.054, 0.06, 0.004]),
    ]
  }

  /// A block with grooves 12 mm wide and 22 mm deep.
  private var ribs: [Mesh] {
    [box([-0.055, 0.045, -0.088], [0.045, 0.035, 0.006])]
      + (0..<4).map { index in
        box([-0.092 + 0.02 * Double(index), 0.045, -0.071], [0.004, 0.035, 0.011])
      }
  }

  private var arch: [Mesh] {
    let ring = Mesh.tube(
      along: { t in
        let angle = .pi * (1 - t)
        return SIMD3(0.055 + 0.04 * cos(angle), 0.075 + 0.04 * sin(angle), -0.06)
      }, side: [0, 0, 1], halfAxes: SIMD2(repeating: 0.013), length: 0.126, columns: cells(120),
      rows: cells(200))
    return [
      box([0.015, 0.04, -0.06], [0.013, 0.035, 0.016]),
      box([0.095, 0.04, -0.06], [0.013, 0.035, 0.016]), ring,
    ]
  }
}
