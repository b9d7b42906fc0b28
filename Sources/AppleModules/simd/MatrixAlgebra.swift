// The algebra that the matrices of both precisions share, on their columns.

typealias Columns3<S: SIMDScalar> = (SIMD3<S>, SIMD3<S>, SIMD3<S>)
typealias Columns4<S: SIMDScalar> = (SIMD4<S>, SIMD4<S>, SIMD4<S>, SIMD4<S>)

func transposed<S: SIMDScalar>(_ m: Columns3<S>) -> Columns3<S> {
  (
    SIMD3(m.0.x, m.1.x, m.2.x), SIMD3(m.0.y, m.1.y, m.2.y), SIMD3(m.0.z, m.1.z, m.2.z)
  )
}

func transposed<S: SIMDScalar>(_ m: Columns4<S>) -> Columns4<S> {
  (
    SIMD4(m.0.x, m.1.x, m.2.x, m.3.x), SIMD4(m.0.y, m.1.y, m.2.y, m.3.y),
    SIMD4(m.0.z, m.1.z, m.2.z, m.3.z), SIMD4(m.0.w, m.1.w, m.2.w, m.3.w)
  )
}

func determinant<S: SIMDScalar & FloatingPoint>(_ m: Columns3<S>) -> S {
  dot(m.0, cross(m.1, m.2))
}

/// The inverse by the adjugate; not finite if the matrix is singular.
func inverted<S: SIMDScalar & FloatingPoint>(_ m: Columns3<S>) -> Columns3<S> {
  let rows = (cross(m.1, m.2), cross(m.2, m.0), cross(m.0, m.1))
  let scale = 1 / dot(m.0, rows.0)
  return transposed((rows.0 * scale, rows.1 * scale, rows.2 * scale))
}

/// The 2×2 minors of the upper (s) and the lower (c) two rows, for Laplace's expansion.
private func minors<S: SIMDScalar & FloatingPoint>(_ m: Columns4<S>) -> (s: [S], c: [S]) {
  let pairs = [(m.0, m.1), (m.0, m.2), (m.0, m.3), (m.1, m.2), (m.1, m.3), (m.2, m.3)]
  return (
    pairs.map { $0.x * $1.y - $1.x * $0.y }, pairs.map { $0.z * $1.w - $1.z * $0.w }
  )
}

func determinant<S: SIMDScalar & FloatingPoint>(_ m: Columns4<S>) -> S {
  let (s, c) = minors(m)
  let outer = s[0] * c[5] - s[1] * c[4] + s[2] * c[3]
  return outer + s[3] * c[2] - s[4] * c[1] + s[5] * c[0]
}

/// The inverse by the adjugate; not finite if the matrix is singular.
func inverted<S: SIMDScalar & FloatingPoint>(_ m: Columns4<S>) -> Columns4<S> {
  let (s, c) = minors(m)
  let scale = 1 / determinant(m)
  /// A column of the adjugate from one row of the matrix and the opposite minors.
  func column(_ row: (S, S, S, S), _ k: [S], _ sign: S) -> SIMD4<S> {
    let x = row.1 * k[5] - row.2 * k[4] + row.3 * k[3]
    let y = row.0 * k[5] - row.2 * k[2] + row.3 * k[1]
    let z = row.0 * k[4] - row.1 * k[2] + row.3 * k[0]
    let w = row.0 * k[3] - row.1 * k[1] + row.2 * k[0]
    return SIMD4(x, -y, z, -w) * (sign * scale)
  }
  let rows = transposed(m)
  func scalars(_ v: SIMD4<S>) -> (S, S, S, S) { (v.x, v.y, v.z, v.w) }
  return (
    column(scalars(rows.1), c, 1), column(scalars(rows.0), c, -1),
    column(scalars(rows.3), s, 1), column(scalars(rows.2), s, -1)
  )
}

func product<S: SIMDScalar & FloatingPoint>(_ m: Columns3<S>, _ v: SIMD3<S>) -> SIMD3<S> {
  m.0 * v.x + m.1 * v.y + m.2 * v.z
}

func product<S: SIMDScalar & FloatingPoint>(_ m: Columns4<S>, _ v: SIMD4<S>) -> SIMD4<S> {
  (m.0 * v.x + m.1 * v.y) + (m.2 * v.z + m.3 * v.w)
}
