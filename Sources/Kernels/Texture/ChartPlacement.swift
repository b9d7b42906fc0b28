/// The placement of a packed chart: `texel = scale · R · plane + offset`, y down.
package struct ChartPlacement: Hashable, Sendable {
  /// Texels per unit of length of the chart's plane.
  package var scale: Float
  /// Number of rotations by 90° from x to y.
  package var quarterTurns: Int
  /// Texels.
  package var offset: SIMD2<Float>
  /// Index of the atlas.
  package var atlas: Int

  /// The texel position of a point of the chart's plane.
  package func texel(_ p: SIMD2<Float>) -> SIMD2<Float> {
    let q = scale * p
    let turned: SIMD2<Float> =
      switch quarterTurns & 3 {
      case 1: [-q.y, q.x]
      case 2: [-q.x, -q.y]
      case 3: [q.y, -q.x]
      default: q
      }
    return turned + offset
  }
}
