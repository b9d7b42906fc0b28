import SceneModel

/// The integer coordinates of a model's positions: a cubic grid over its bounds.
///
/// All parts of a model share the grid, so that their borders stay together. It is a cube, since
/// normals would need another transform than positions if the axes had different scales.
package struct PositionGrid: Equatable, Sendable {
  /// Bits per coordinate. Chosen: at 16 bits the error is at most a 130,000th of the model's
  /// longest side: a tenth of a texel of an atlas of 8192² texels, which has about 5,000 across
  /// such a model. 14 bits would be enough up to 2048² texels, but save only 2 % of the file.
  static let bits = 16
  private static let maximum = Float(1 << bits - 1)

  /// The smallest corner of the bounds.
  package let origin: SIMD3<Float>
  /// The distance of two grid points, in the unit of the positions.
  package let step: Float
  /// The side of the cube.
  package var extent: Float { step * Self.maximum }

  /// The grid over the bounds of `positions`.
  package init(_ positions: [SIMD3<Float>]) {
    let bounds = Mesh(positions: positions).bounds ?? (.zero, .zero)
    let extent = (bounds.max - bounds.min).max()
    origin = bounds.min
    step = extent > 0 && extent.isFinite ? extent / Self.maximum : 1
  }

  /// The nearest grid point.
  package func coordinates(of position: SIMD3<Float>) -> SIMD3<UInt16> {
    let v = ((position - origin) / step).rounded(.toNearestOrAwayFromZero)
    return SIMD3(Self.clamped(v.x), Self.clamped(v.y), Self.clamped(v.z))
  }

  private static func clamped(_ value: Float) -> UInt16 {
    value > 0 ? UInt16(min(value, maximum)) : 0
  }
}
