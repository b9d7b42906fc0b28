extension SIMD3 where Scalar: FloatingPoint {
  /// The dot product.
  @inlinable package func dot(_ other: Self) -> Scalar { (self * other).sum() }

  /// The cross product.
  @inlinable package func cross(_ other: Self) -> Self {
    Self(
      y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x)
  }

  /// The squared Euclidean norm.
  @inlinable package var squaredLength: Scalar { dot(self) }

  /// The Euclidean norm.
  @inlinable package var length: Scalar { squaredLength.squareRoot() }

  /// The vector scaled to unit length; the zero vector stays zero.
  @inlinable package var normalized: Self {
    let length = length
    return length > 0 ? self / length : self
  }

  /// Whether all components are finite.
  @inlinable package var isFinite: Bool { x.isFinite && y.isFinite && z.isFinite }
}

extension SIMD2 where Scalar: FloatingPoint {
  /// The dot product.
  @inlinable package func dot(_ other: Self) -> Scalar { (self * other).sum() }

  /// The squared Euclidean norm.
  @inlinable package var squaredLength: Scalar { dot(self) }

  /// The Euclidean norm.
  @inlinable package var length: Scalar { squaredLength.squareRoot() }
}
