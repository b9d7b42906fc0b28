// Componentwise functions of vectors of floating-point scalars.

/// −1, 0 or 1 for each component.
public func sign<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { mapped(x) { $0.sign() } }

/// The fractional part of each component: the distance to the next integer below.
public func fract<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  x - x.rounded(.down)
}

/// Each component rounded down to an integer.
public func floor<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.down) }

/// Each component rounded up to an integer.
public func ceil<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.up) }

/// Each component rounded toward zero to an integer.
public func trunc<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.towardZero) }

/// The reciprocal of each component.
public func recip<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { 1 / x }

/// The reciprocal square root of each component.
public func rsqrt<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { 1 / x.squareRoot() }

/// The square root of each component.
public func sqrt<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.squareRoot() }

/// 0 for each component below the edge, and 1 for the others.
public func step<V: SIMD>(_ x: V, edge: V) -> V where V.Scalar: FloatingPoint {
  V(repeating: 1).replacing(with: 0, where: x .< edge)
}

/// Hermite interpolation from 0 at the lower edge to 1 at the upper edge, clamped outside.
public func smoothstep<V: SIMD>(_ x: V, edge0: V, edge1: V) -> V
where V.Scalar: FloatingPoint {
  let share = ((x - edge0) / (edge1 - edge0)).clamped(
    lowerBound: V(repeating: 0), upperBound: V(repeating: 1))
  return share * share * (3 - 2 * share)
}

/// The direction of a ray refracted at a surface with the unit normal `n`; zero on total internal
/// reflection.
public func refract<V: SIMD>(_ x: V, n: V, eta: V.Scalar) -> V where V.Scalar: FloatingPoint {
  let cosine = dot(x, n)
  let rest = 1 - eta * eta * (1 - cosine * cosine)
  guard rest >= 0 else { return V(repeating: 0) }
  return eta * x - (eta * cosine + rest.squareRoot()) * n
}

private func mapped<V: SIMD>(_ x: V, _ function: (V.Scalar) -> V.Scalar) -> V {
  var result = x
  for index in x.indices { result[index] = function(x[index]) }
  return result
}

extension FloatingPoint {
  fileprivate func sign() -> Self { self > 0 ? 1 : self < 0 ? -1 : 0 }
}
