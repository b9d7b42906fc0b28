import Foundation
import SceneModel

/// Objects 0.21 to 0.3 m long for `CaptureScene`, closed on all sides. Their frame has +y up and
/// its origin below the middle of the object, which stands or lies on y = 0.
package enum CaptureObject: String, CaseIterable, Sendable {
  case statue, box, vase, axe

  /// - Parameter fineness: scales the number of triangles per side.
  package func mesh(fineness: Double = 1) -> Mesh {
    func cells(_ count: Int) -> Int { max(4, Int(Double(count) * fineness)) }
    let mesh =
      switch self {
      case .statue: Self.statue(cells)
      case .box: Self.box(cells)
      case .vase: Self.vase(cells)
      case .axe: Self.axe(cells)
      }
    let (low, high) = mesh.captureBounds
    return mesh.moved(
      by: RigidTransform(
        rotation: .identity,
        translation: -SIMD3((low.x + high.x) / 2, low.y, (low.z + high.z) / 2)))
  }

  /// How the object is turned to lie on another side.
  var turnedOver: Quaternion {
    switch self {
    // Lying on the plinth and the head.
    case .statue: Quaternion(angle: 100 * .pi / 180, axis: [0, 0, 1])
    case .box: Quaternion(angle: .pi / 2, axis: [1, 0, 0])
    case .vase: Quaternion(angle: .pi, axis: [0, 0, 1])
    case .axe: Quaternion(angle: .pi, axis: [1, 0, 0])
    }
  }

  private static func statue(_ cells: (Int) -> Int) -> Mesh {
    var mesh = RenderedScene.statueMesh(columns: cells(260), rows: cells(180))
    mesh.closeBottom(columns: cells(260))
    return mesh
  }

  /// A box of 22 × 14 × 9 cm that narrows upward, with bumps and dents up to 9 mm on its sides.
  private static func box(_ cells: (Int) -> Int) -> Mesh {
    let half = SIMD3(0.11, 0.07, 0.045)
    // Places in multiples of `half`, radii and heights in meters.
    let bumps: [(at: SIMD3<Double>, radius: Double, height: Double)] = [
      ([0.45, 0.2, 1], 0.022, 0.008), ([-0.4, -0.25, 1], 0.03, -0.009),
      ([-0.5, 0.3, -1], 0.025, 0.009), ([0.4, 1, 0.1], 0.02, 0.009),
      ([-0.35, 1, -0.1], 0.024, -0.007), ([1, -0.1, -0.2], 0.018, 0.009),
      ([-1, 0.15, 0.2], 0.02, -0.008), ([0.2, -1, 0.1], 0.022, -0.007),
    ]
    return Mesh.box(center: .zero, halfSize: half, cells: cells(70)).deformed { point in
      var result = point
      for bump in bumps {
        let distance = (point - bump.at * half).length / bump.radius
        guard distance < 1 else { continue }
        let outward = SIMD3<Double>(
          abs(bump.at.x) == 1 ? bump.at.x : 0, abs(bump.at.y) == 1 ? bump.at.y : 0,
          abs(bump.at.z) == 1 ? bump.at.z : 0)
        result += outward * (bump.height * pow(cos(distance * .pi / 2), 2))
      }
      let narrowing = 0.95 - 0.06 * point.y / half.y
      return SIMD3(result.x * narrowing, result.y, result.z * (1.5 * narrowing - 0.5))
    }
  }

  /// A vase of 21 cm with a shallow mouth and two different handles.
  private static func vase(_ cells: (Int) -> Int) -> Mesh {
    var mesh = Mesh.turned(
      [
        [0, 0], [0.03, 0], [0.043, 0.001], [0.047, 0.006], [0.052, 0.03], [0.066, 0.075],
        [0.068, 0.11], [0.05, 0.15], [0.034, 0.175], [0.036, 0.195], [0.046, 0.208],
        [0.045, 0.212], [0.04, 0.21], [0.03, 0.195], [0.026, 0.175], [0.02, 0.163], [0, 0.16],
      ], columns: cells(240), rows: cells(220)
    ).deformed()
    mesh.append(
      .tube(
        along: { t in
          let angle = .pi * (t - 0.5)
          return SIMD3(0.032 + 0.06 * cos(angle), 0.145 + 0.045 * sin(angle), 0)
        }, side: [0, 0, 1], halfAxes: [0.007, 0.009], length: 0.152, columns: cells(40),
        rows: cells(120)))
    mesh.append(
      .tube(
        along: { t in
          let angle = .pi * (t - 0.5)
          let reach = 0.045 + 0.042 * cos(angle)
          return SIMD3(-0.8 * reach, 0.1 + 0.03 * sin(angle), -0.6 * reach)
        }, side: [-0.6, 0, 0.8], halfAxes: [0.008, 0.006], length: 0.114, columns: cells(40),
        rows: cells(120)))
    return mesh
  }

  /// An axe of 30 cm lying on its side: a curved shaft along x, and a head with its edge toward +z.
  private static func axe(_ cells: (Int) -> Int) -> Mesh {
    var mesh = Mesh.tube(
      along: { t in
        SIMD3(0.3 * t - 0.15, 0.018 - 0.005 * pow(1 - t, 2), -0.02 * sin(.pi * (1 - t) * 1.3))
      }, side: [0, 1, 0], halfAxes: [0.016, 0.012], length: 0.3, columns: cells(100),
      rows: cells(300), widening: { 1 + 0.35 * pow(abs(2 * $0 - 1), 4) })
    let head = Mesh.box(center: .zero, halfSize: [0.026, 0.018, 0.065], cells: cells(90))
    mesh.append(
      head.deformed { point in
        // From the back, 0, to the edge, 1.
        let t = (point.z / 0.065 + 1) / 2
        let flare = 0.85 + 0.9 * t * t * t
        let thickness = 1 - 0.93 * pow(t, 1.5)
        let curve = 0.012 * t * (1 - pow(point.x / 0.026, 2))
        return SIMD3(
          0.105 + point.x * flare, 0.018 + point.y * thickness, 0.028 + point.z + curve)
      })
    return mesh
  }
}

extension Mesh {
  /// The corners of its bounding box.
  var captureBounds: (low: SIMD3<Double>, high: SIMD3<Double>) {
    let first = positions.first ?? .zero
    let (low, high) = positions.reduce((first, first)) {
      (pointwiseMin($0.0, $1), pointwiseMax($0.1, $1))
    }
    return (SIMD3<Double>(low), SIMD3<Double>(high))
  }
}
