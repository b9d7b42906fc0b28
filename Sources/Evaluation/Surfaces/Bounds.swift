import SceneModel

/// An axis-aligned box.
struct Bounds: Sendable {
  let min: SIMD3<Float>
  let max: SIMD3<Float>

  /// The smallest box that contains the positions; nil if there are none.
  init?(_ positions: [SIMD3<Float>]) {
    guard let bounds = Mesh(positions: positions).bounds else { return nil }
    (min, max) = bounds
  }

  var volume: Double {
    let size = SIMD3<Double>(max) - SIMD3<Double>(min)
    return size.x * size.y * size.z
  }

  func contains(_ point: SIMD3<Float>, margin: SIMD3<Float> = .zero) -> Bool {
    pointwiseMin(pointwiseMax(point, min - margin), max + margin) == point
  }
}
