import Foundation

// The algebra that quaternions of both precisions share, on vectors (x, y, z, w) with w real.

func imaginary<S: SIMDScalar>(_ q: SIMD4<S>) -> SIMD3<S> { SIMD3(q.x, q.y, q.z) }

func hamiltonProduct<S: SIMDScalar & FloatingPoint>(_ a: SIMD4<S>, _ b: SIMD4<S>) -> SIMD4<S> {
  let (u, v) = (imaginary(a), imaginary(b))
  let imag = v * a.w + u * b.w + cross(u, v)
  return SIMD4(imag, a.w * b.w - dot(u, v))
}

func conjugated<S: SIMDScalar & FloatingPoint>(_ q: SIMD4<S>) -> SIMD4<S> {
  SIMD4(-q.x, -q.y, -q.z, q.w)
}

func rotated<S: SIMDScalar & FloatingPoint>(_ v: SIMD3<S>, by q: SIMD4<S>) -> SIMD3<S> {
  let u = imaginary(q)
  let t = cross(u, v) * 2
  return v + t * q.w + cross(u, t)
}

/// The columns of the rotation matrix of a unit quaternion.
func rotationColumns<S: SIMDScalar & FloatingPoint>(_ q: SIMD4<S>) -> Columns3<S> {
  let (x, y, z, w) = (q.x, q.y, q.z, q.w)
  let (xx, yy, zz) = (x * x, y * y, z * z)
  return (
    SIMD3(1 - 2 * (yy + zz), 2 * (x * y + z * w), 2 * (x * z - y * w)),
    SIMD3(2 * (x * y - z * w), 1 - 2 * (xx + zz), 2 * (y * z + x * w)),
    SIMD3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (xx + yy))
  )
}

/// The unit quaternion of a proper rotation matrix (Shepperd 1978: divide by the largest
/// component).
func quaternion<S: SIMDScalar & FloatingPoint>(ofRotation m: Columns3<S>) -> SIMD4<S> {
  let (d0, d1, d2) = (m.0.x, m.1.y, m.2.z)
  let trace = d0 + d1 + d2
  if trace >= 0 {
    let r = 2 * (1 + trace).squareRoot()
    return SIMD4((m.1.z - m.2.y) / r, (m.2.x - m.0.z) / r, (m.0.y - m.1.x) / r, r / 4)
  }
  if d0 >= d1, d0 >= d2 {
    let r = 2 * (1 - d1 - d2 + d0).squareRoot()
    return SIMD4(r / 4, (m.0.y + m.1.x) / r, (m.0.z + m.2.x) / r, (m.1.z - m.2.y) / r)
  }
  if d1 >= d2 {
    let r = 2 * (1 - d0 - d2 + d1).squareRoot()
    return SIMD4((m.0.y + m.1.x) / r, r / 4, (m.1.z + m.2.y) / r, (m.2.x - m.0.z) / r)
  }
  let r = 2 * (1 - d0 - d1 + d2).squareRoot()
  return SIMD4((m.0.z + m.2.x) / r, (m.1.z + m.2.y) / r, r / 4, (m.0.y - m.1.x) / r)
}

/// The shortest rotation that turns the unit vector `from` to the unit vector `to`.
func quaternion<S: SIMDScalar & FloatingPoint>(
  turning from: SIMD3<S>, to: SIMD3<S>
) -> SIMD4<S> {
  if dot(from, to) >= 0 { return quaternion(halfwayFrom: from, to: to) }
  let sum = from + to
  // If the two are opposite, any axis perpendicular to them is valid.
  guard dot(sum, sum) > S.ulpOfOne else {
    let magnitude = abs(from)
    let basis: SIMD3<S> =
      magnitude.x <= magnitude.y && magnitude.x <= magnitude.z
      ? SIMD3(1, 0, 0) : (magnitude.y <= magnitude.z ? SIMD3(0, 1, 0) : SIMD3(0, 0, 1))
    return SIMD4(normalize(cross(from, basis)), 0)
  }
  let half = normalize(sum)
  return hamiltonProduct(
    quaternion(halfwayFrom: half, to: to), quaternion(halfwayFrom: from, to: half))
}

/// As above for vectors at most a right angle apart, where the half vector is well defined.
private func quaternion<S: SIMDScalar & FloatingPoint>(
  halfwayFrom from: SIMD3<S>, to: SIMD3<S>
) -> SIMD4<S> {
  let half = normalize(from + to)
  return SIMD4(cross(from, half), dot(from, half))
}
