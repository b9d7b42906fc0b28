// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A vector of two 32-bit floating-point scalars.
public typealias simd_float2 = SIMD2<Float>
/// A vector of three 32-bit floating-point scalars.
public typealias simd_float3 = SIMD3<Float>
/// A vector of four 32-bit floating-point scalars.
public typealias simd_float4 = SIMD4<Float>
/// A vector of two 64-bit floating-point scalars.
public typealias simd_double2 = SIMD2<Double>
/// A vector of three 64-bit floating-point scalars.
public typealias simd_double3 = SIMD3<Double>
/// A vector of four 64-bit floating-point scalars.
public typealias simd_double4 = SIMD4<Double>
/// A vector of two 32-bit signed integers.
public typealias simd_int2 = SIMD2<Int32>
/// A vector of three 32-bit signed integers.
public typealias simd_int3 = SIMD3<Int32>
/// A vector of four 32-bit signed integers.
public typealias simd_int4 = SIMD4<Int32>
/// A vector of two 32-bit unsigned integers.
public typealias simd_uint2 = SIMD2<UInt32>
/// A vector of three 32-bit unsigned integers.
public typealias simd_uint3 = SIMD3<UInt32>
/// A vector of four 32-bit unsigned integers.
public typealias simd_uint4 = SIMD4<UInt32>
/// A vector of four 8-bit unsigned integers.
public typealias simd_uchar4 = SIMD4<UInt8>

/// The former name of `simd_float2`.
public typealias float2 = SIMD2<Float>
/// The former name of `simd_float3`.
public typealias float3 = SIMD3<Float>
/// The former name of `simd_float4`.
public typealias float4 = SIMD4<Float>
/// The former name of `simd_double2`.
public typealias double2 = SIMD2<Double>
/// The former name of `simd_double3`.
public typealias double3 = SIMD3<Double>
/// The former name of `simd_double4`.
public typealias double4 = SIMD4<Double>
/// The name in C of `simd_float2`.
public typealias vector_float2 = SIMD2<Float>
/// The name in C of `simd_float3`.
public typealias vector_float3 = SIMD3<Float>
/// The name in C of `simd_float4`.
public typealias vector_float4 = SIMD4<Float>
/// The name in C of `simd_double2`.
public typealias vector_double2 = SIMD2<Double>
/// The name in C of `simd_double3`.
public typealias vector_double3 = SIMD3<Double>
/// The name in C of `simd_double4`.
public typealias vector_double4 = SIMD4<Double>
/// The name in C of `simd_int2`.
public typealias vector_int2 = SIMD2<Int32>
/// The name in C of `simd_int3`.
public typealias vector_int3 = SIMD3<Int32>
/// The name in C of `simd_int4`.
public typealias vector_int4 = SIMD4<Int32>
/// The name in C of `simd_uint2`.
public typealias vector_uint2 = SIMD2<UInt32>
/// The name in C of `simd_uint3`.
public typealias vector_uint3 = SIMD3<UInt32>
/// The name in C of `simd_uint4`.
public typealias vector_uint4 = SIMD4<UInt32>
/// The name in C of `simd_uchar4`.
public typealias vector_uchar4 = SIMD4<UInt8>

/// Makes a vector of two scalars.
public func simd_make_float2(_ x: Float, _ y: Float) -> simd_float2 { simd_float2(x, y) }

/// Makes a vector of three scalars.
public func simd_make_float3(_ x: Float, _ y: Float, _ z: Float) -> simd_float3 {
  simd_float3(x, y, z)
}

/// The first three components of a vector.
public func simd_make_float3(_ other: simd_float4) -> simd_float3 {
  simd_float3(other.x, other.y, other.z)
}

/// Extends a vector by a third component.
public func simd_make_float3(_ xy: simd_float2, _ z: Float) -> simd_float3 { simd_float3(xy, z) }

/// Makes a vector of four scalars.
public func simd_make_float4(_ x: Float, _ y: Float, _ z: Float, _ w: Float) -> simd_float4 {
  simd_float4(x, y, z, w)
}

/// Extends a vector by a fourth component.
public func simd_make_float4(_ xyz: simd_float3, _ w: Float) -> simd_float4 { simd_float4(xyz, w) }

/// Extends a vector by a zero.
public func simd_make_float4(_ xyz: simd_float3) -> simd_float4 { simd_float4(xyz, 0) }
