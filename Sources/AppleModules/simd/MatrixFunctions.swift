// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The matrix functions under their C names and former names.

/// The product of two matrices.
public func matrix_multiply(_ x: simd_float4x4, _ y: simd_float4x4) -> simd_float4x4 { x * y }

/// The product of a matrix and a column vector.
public func matrix_multiply(_ x: simd_float4x4, _ y: simd_float4) -> simd_float4 { x * y }

/// The product of two matrices.
public func matrix_multiply(_ x: simd_float3x3, _ y: simd_float3x3) -> simd_float3x3 { x * y }

/// The product of a matrix and a column vector.
public func matrix_multiply(_ x: simd_float3x3, _ y: simd_float3) -> simd_float3 { x * y }

/// The inverse of a matrix.
public func matrix_invert(_ x: simd_float4x4) -> simd_float4x4 { x.inverse }

/// The inverse of a matrix.
public func matrix_invert(_ x: simd_float3x3) -> simd_float3x3 { x.inverse }

/// The transpose of a matrix.
public func matrix_transpose(_ x: simd_float4x4) -> simd_float4x4 { x.transpose }

/// The transpose of a matrix.
public func matrix_transpose(_ x: simd_float3x3) -> simd_float3x3 { x.transpose }

/// The determinant of a matrix.
public func matrix_determinant(_ x: simd_float4x4) -> Float { x.determinant }

/// The determinant of a matrix.
public func matrix_determinant(_ x: simd_float3x3) -> Float { x.determinant }

/// The sum of multiples of two matrices.
public func simd_linear_combination(
  _ a: Float, _ x: simd_float4x4, _ b: Float, _ y: simd_float4x4
) -> simd_float4x4 { a * x + b * y }

/// Whether all elements are the same.
public func simd_equal(_ x: simd_float4x4, _ y: simd_float4x4) -> Bool { x == y }

/// Whether all elements are the same.
public func simd_equal(_ x: simd_float3x3, _ y: simd_float3x3) -> Bool { x == y }

/// Whether all components are the same.
public func simd_equal<V: SIMD>(_ x: V, _ y: V) -> Bool { x == y }
