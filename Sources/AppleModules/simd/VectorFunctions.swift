// The functions of vectors of any length and floating-point type.

/// The dot product.
@inlinable public func dot<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  (x * y).sum()
}

/// The square of the Euclidean length.
@inlinable public func length_squared<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  dot(x, x)
}

/// The Euclidean length.
@inlinable public func length<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  dot(x, x).squareRoot()
}

/// The L1 norm: the sum of the absolute components.
@inlinable public func norm_one<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  abs(x).sum()
}

/// The maximum norm: the largest absolute component.
@inlinable public func norm_inf<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  abs(x).max()
}

/// The Euclidean distance between two points.
@inlinable public func distance<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  length(x - y)
}

/// The square of the Euclidean distance between two points.
@inlinable public func distance_squared<V: SIMD>(_ x: V, _ y: V) -> V.Scalar
where V.Scalar: FloatingPoint {
  length_squared(x - y)
}

/// The unit vector of the same direction; NaN for the zero vector.
@inlinable public func normalize<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  x / length(x)
}

/// The projection of `x` onto `y`.
@inlinable public func project<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: FloatingPoint {
  y * (dot(x, y) / dot(y, y))
}

/// The reflection of `x` at the plane with the unit normal `n`.
@inlinable public func reflect<V: SIMD>(_ x: V, n: V) -> V where V.Scalar: FloatingPoint {
  x - n * (2 * dot(x, n))
}

/// The cross product, right-handed.
@inlinable public func cross<S: SIMDScalar & FloatingPoint>(
  _ x: SIMD3<S>, _ y: SIMD3<S>
) -> SIMD3<S> {
  let ySwizzled = SIMD3(y.y, y.z, y.x)
  let difference = x * ySwizzled - SIMD3(x.y, x.z, x.x) * y
  return SIMD3(difference.y, difference.z, difference.x)
}

/// The cross product of two vectors in the plane: its z component is the signed area they span.
@inlinable public func cross<S: SIMDScalar & FloatingPoint>(
  _ x: SIMD2<S>, _ y: SIMD2<S>
) -> SIMD3<S> {
  SIMD3(0, 0, x.x * y.y - x.y * y.x)
}

/// The absolute value of each component.
@inlinable public func abs<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  x.replacing(with: 0 - x, where: x .< 0)
}

/// The componentwise minimum.
@inlinable public func min<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable {
  pointwiseMin(x, y)
}

/// The componentwise maximum.
@inlinable public func max<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable {
  pointwiseMax(x, y)
}

/// Each component clamped to a range with bounds for each component.
@inlinable public func clamp<V: SIMD>(_ x: V, min lower: V, max upper: V) -> V
where V.Scalar: Comparable {
  x.clamped(lowerBound: lower, upperBound: upper)
}

/// Each component clamped to a range.
@inlinable public func clamp<V: SIMD>(
  _ x: V, min lower: V.Scalar, max upper: V.Scalar
) -> V where V.Scalar: Comparable {
  x.clamped(lowerBound: V(repeating: lower), upperBound: V(repeating: upper))
}

/// Linear interpolation from `x` (t = 0) to `y` (t = 1).
@inlinable public func mix<V: SIMD>(_ x: V, _ y: V, t: V.Scalar) -> V
where V.Scalar: FloatingPoint {
  x + (y - x) * t
}

/// Linear interpolation from `x` (t = 0) to `y` (t = 1), componentwise.
@inlinable public func mix<V: SIMD>(_ x: V, _ y: V, t: V) -> V where V.Scalar: FloatingPoint {
  x + (y - x) * t
}

/// The sum of all components.
@inlinable public func reduce_add<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  x.sum()
}

/// The smallest component.
@inlinable public func reduce_min<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable {
  x.min()
}

/// The largest component.
@inlinable public func reduce_max<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable {
  x.max()
}
