// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The matrix functions under their C names and former names.

/// The product of two matrices.
@inlinable public func simd_mul<M: SIMDMatrix>(_ x: M, _ y: M) -> M { x * y }

/// The product of a matrix and a column vector.
@inlinable public func simd_mul<M: SIMDMatrix>(_ x: M, _ y: M.Column) -> M.Column { x * y }

/// The inverse of a matrix.
@inlinable public func simd_inverse<M: SIMDMatrix>(_ x: M) -> M { x.inverse }

/// The transpose of a matrix.
@inlinable public func simd_transpose<M: SIMDMatrix>(_ x: M) -> M { x.transpose }

/// The determinant of a matrix.
@inlinable public func simd_determinant<M: SIMDMatrix>(_ x: M) -> M.Scalar { x.determinant }

/// The sum of multiples of two matrices.
@inlinable public func simd_linear_combination<M: SIMDMatrix>(
  _ a: M.Scalar, _ x: M, _ b: M.Scalar, _ y: M
) -> M { a * x + b * y }

/// Whether corresponding elements differ by no more than `tolerance`.
@inlinable public func simd_almost_equal_elements<M: SIMDMatrix>(
  _ x: M, _ y: M, _ tolerance: M.Scalar
) -> Bool {
  (0..<M.Column.scalarCount).allSatisfy { norm_inf(x[$0] - y[$0]) <= tolerance }
}

/// Whether all elements are the same.
@inlinable public func simd_equal<M: SIMDMatrix>(_ x: M, _ y: M) -> Bool { x == y }

/// Whether all components are the same.
@inlinable public func simd_equal<V: SIMD>(_ x: V, _ y: V) -> Bool { x == y }

/// The product of two matrices.
@inlinable public func matrix_multiply<M: SIMDMatrix>(_ x: M, _ y: M) -> M { x * y }

/// The product of a matrix and a column vector.
@inlinable public func matrix_multiply<M: SIMDMatrix>(_ x: M, _ y: M.Column) -> M.Column { x * y }

/// The inverse of a matrix.
@inlinable public func matrix_invert<M: SIMDMatrix>(_ x: M) -> M { x.inverse }

/// The transpose of a matrix.
@inlinable public func matrix_transpose<M: SIMDMatrix>(_ x: M) -> M { x.transpose }

/// The determinant of a matrix.
@inlinable public func matrix_determinant<M: SIMDMatrix>(_ x: M) -> M.Scalar { x.determinant }
