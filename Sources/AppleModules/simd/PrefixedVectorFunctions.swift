// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The vector functions under their C names.

/// The dot product.
@inlinable public func simd_dot<V: SIMD>(_ x: V, _ y: V) -> V.Scalar where V.Scalar: FloatingPoint {
  dot(x, y)
}

/// The cross product, right-handed.
@inlinable public func simd_cross<S: SIMDScalar & FloatingPoint>(
  _ x: SIMD3<S>, _ y: SIMD3<S>
) -> SIMD3<S> { cross(x, y) }

/// The Euclidean length.
@inlinable public func simd_length<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  length(x)
}

/// The square of the Euclidean length.
@inlinable public func simd_length_squared<V: SIMD>(_ x: V) -> V.Scalar
where V.Scalar: FloatingPoint {
  length_squared(x)
}

/// The Euclidean distance between two points.
@inlinable public func simd_distance<V: SIMD>(_ x: V, _ y: V) -> V.Scalar
where V.Scalar: FloatingPoint {
  distance(x, y)
}

/// The square of the Euclidean distance between two points.
@inlinable public func simd_distance_squared<V: SIMD>(
  _ x: V, _ y: V
) -> V.Scalar where V.Scalar: FloatingPoint {
  distance_squared(x, y)
}

/// The unit vector of the same direction; NaN for the zero vector.
@inlinable public func simd_normalize<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  normalize(x)
}

/// The projection of `x` onto `y`.
@inlinable public func simd_project<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: FloatingPoint {
  project(x, y)
}

/// The reflection of `x` at the plane with the unit normal `n`.
@inlinable public func simd_reflect<V: SIMD>(_ x: V, _ n: V) -> V where V.Scalar: FloatingPoint {
  reflect(x, n: n)
}

/// The absolute value of each component.
@inlinable public func simd_abs<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { abs(x) }

/// The componentwise minimum.
@inlinable public func simd_min<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable {
  min(x, y)
}

/// The componentwise maximum.
@inlinable public func simd_max<V: SIMD>(_ x: V, _ y: V) -> V where V.Scalar: Comparable {
  max(x, y)
}

/// Each component clamped to a range.
@inlinable public func simd_clamp<V: SIMD>(_ x: V, _ lower: V, _ upper: V) -> V
where V.Scalar: Comparable {
  clamp(x, min: lower, max: upper)
}

/// Linear interpolation from `x` (t = 0) to `y` (t = 1), componentwise.
@inlinable public func simd_mix<V: SIMD>(_ x: V, _ y: V, _ t: V) -> V
where V.Scalar: FloatingPoint {
  mix(x, y, t: t)
}

/// The sum of all components.
@inlinable public func simd_reduce_add<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: FloatingPoint {
  x.sum()
}

/// The smallest component.
@inlinable public func simd_reduce_min<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable {
  x.min()
}

/// The largest component.
@inlinable public func simd_reduce_max<V: SIMD>(_ x: V) -> V.Scalar where V.Scalar: Comparable {
  x.max()
}
