// The functions that work on vectors of any length and floating-point type.

/// The sum of the products of corresponding components.
public func dot<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  (x * y).sum()
}

/// The square of the Euclidean length.
public func length_squared<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint { dot(x, x) }

/// The Euclidean length.
public func length<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  dot(x, x).squareRoot()
}

/// The sum of the components' magnitudes.
public func norm_one<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint { abs(x).sum() }

/// The largest magnitude of a component.
public func norm_inf<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint { abs(x).max() }

/// The Euclidean distance between two points.
public func distance<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  length(x - y)
}

/// The square of the Euclidean distance between two points.
public func distance_squared<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  length_squared(x - y)
}

/// The vector of the same direction with length 1; not a number for the zero vector.
public func normalize<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x / length(x) }

/// The component of `x` along `y`.
public func project<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: FloatingPoint {
  y * (dot(x, y) / dot(y, y))
}

/// The reflection of `x` at the plane with the unit normal `n`.
public func reflect<V: SIMD>(_ x: V, n: V) -> V where V.Scalar: FloatingPoint {
  x - n * (2 * dot(x, n))
}

/// The vector perpendicular to both, right-handed.
public func cross<S: SIMDScalar & FloatingPoint>(_ x: SIMD3<S>, _ y: SIMD3<S>) -> SIMD3<S> {
  let ySwizzled = SIMD3(y.y, y.z, y.x)
  let difference = x * ySwizzled - SIMD3(x.y, x.z, x.x) * y
  return SIMD3(difference.y, difference.z, difference.x)
}

/// The signed area spanned by two vectors of the plane, as the third component.
public func cross<S: SIMDScalar & FloatingPoint>(_ x: SIMD2<S>, _ y: SIMD2<S>) -> SIMD3<S> {
  SIMD3(0, 0, x.x * y.y - x.y * y.x)
}

/// The magnitude of each component.
public func abs<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  x.replacing(with: 0 - x, where: x .< 0)
}

/// The smaller of each pair of components.
public func min<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable { pointwiseMin(x, y) }

/// The larger of each pair of components.
public func max<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable { pointwiseMax(x, y) }

/// Each component held between those of two bounds.
public func clamp<V: SIMD>(_ x: V, min lower: V, max upper: V) -> V where V.Scalar: Comparable {
  x.clamped(lowerBound: lower, upperBound: upper)
}

/// Each component held between two bounds.
public func clamp<V: SIMD>(
  _ x: V, min lower: V.Scalar, max upper: V.Scalar
) -> V where V.Scalar: Comparable {
  x.clamped(lowerBound: V(repeating: lower), upperBound: V(repeating: upper))
}

/// The point at `t` on the line from `x` (0) to `y` (1).
public func mix<V: SIMD>(_ x: V, _ y: V, t: V.Scalar) -> V where V.Scalar: FloatingPoint {
  x + (y - x) * t
}

/// The point at `t` on the line from `x` (0) to `y` (1), component by component.
public func mix<V: SIMD>(_ x: V, _ y: V, t: V) -> V where V.Scalar: FloatingPoint {
  x + (y - x) * t
}

/// The sum of all components.
public func reduce_add<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint { x.sum() }

/// The smallest component.
public func reduce_min<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable { x.min() }

/// The largest component.
public func reduce_max<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable { x.max() }
