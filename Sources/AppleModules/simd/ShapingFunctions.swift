// The functions that work on each component of a vector of floating-point scalars.

/// −1, 0 or 1 for each component.
public func sign<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { mapped(x) { $0.sign() } }

/// What each component has beyond the whole number below it.
public func fract<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint {
  x - x.rounded(.down)
}

/// The whole number below each component.
public func floor<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.down) }

/// The whole number above each component.
public func ceil<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.up) }

/// Each component without its fraction.
public func trunc<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.rounded(.towardZero) }

/// One over each component.
public func recip<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { 1 / x }

/// One over the square root of each component.
public func rsqrt<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { 1 / x.squareRoot() }

/// The square root of each component.
public func sqrt<V: SIMD>(_ x: V) -> V where V.Scalar: FloatingPoint { x.squareRoot() }

/// 0 for each component below the edge, and 1 for the others.
public func step<V: SIMD>(_ x: V, edge: V) -> V where V.Scalar: FloatingPoint {
  V(repeating: 1).replacing(with: 0, where: x .< edge)
}

/// From 0 below the one edge to 1 above the other, without a corner.
public func smoothstep<V: SIMD>(_ x: V, edge0: V, edge1: V) -> V
where V.Scalar: FloatingPoint {
  let share = ((x - edge0) / (edge1 - edge0)).clamped(
    lowerBound: V(repeating: 0), upperBound: V(repeating: 1))
  return share * share * (3 - 2 * share)
}

/// The direction of a ray behind a surface with the unit normal `n`; zero where it doesn't get through.
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
