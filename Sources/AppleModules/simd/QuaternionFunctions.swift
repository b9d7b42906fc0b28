// swift-format-ignore-file: AlwaysUseLowerCamelCase
// The quaternion functions under their C names.

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ ix: Float, _ iy: Float, _ iz: Float, _ r: Float) -> simd_quatf {
  simd_quatf(ix: ix, iy: iy, iz: iz, r: r)
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ ix: Double, _ iy: Double, _ iz: Double, _ r: Double) -> simd_quatd {
  simd_quatd(ix: ix, iy: iy, iz: iz, r: r)
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ xyzr: simd_float4) -> simd_quatf { simd_quatf(vector: xyzr) }

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ xyzr: simd_double4) -> simd_quatd { simd_quatd(vector: xyzr) }

/// Makes the rotation by `angle` radians about a unit vector.
public func simd_quaternion(_ angle: Float, _ axis: simd_float3) -> simd_quatf {
  simd_quatf(angle: angle, axis: axis)
}

/// Makes the rotation by `angle` radians about a unit vector.
public func simd_quaternion(_ angle: Double, _ axis: simd_double3) -> simd_quatd {
  simd_quatd(angle: angle, axis: axis)
}

/// Makes the shortest rotation that turns one unit vector to another.
public func simd_quaternion(_ from: simd_float3, _ to: simd_float3) -> simd_quatf {
  simd_quatf(from: from, to: to)
}

/// Makes the shortest rotation that turns one unit vector to another.
public func simd_quaternion(_ from: simd_double3, _ to: simd_double3) -> simd_quatd {
  simd_quatd(from: from, to: to)
}

/// The product: the rotation `q` followed by the rotation `p`.
@inlinable public func simd_mul<Q: SIMDQuaternion>(_ p: Q, _ q: Q) -> Q { p * q }

/// Rotates a vector by a unit quaternion.
@inlinable public func simd_act<Q: SIMDQuaternion>(
  _ q: Q, _ v: SIMD3<Q.Scalar>
) -> SIMD3<Q.Scalar> { q.act(v) }

/// The quaternion whose product with `q` is 1.
@inlinable public func simd_inverse<Q: SIMDQuaternion>(_ q: Q) -> Q { q.inverse }

/// The quaternion with the imaginary part negated.
@inlinable public func simd_conjugate<Q: SIMDQuaternion>(_ q: Q) -> Q { q.conjugate }

/// The quaternion scaled to unit length.
@inlinable public func simd_normalize<Q: SIMDQuaternion>(_ q: Q) -> Q { q.normalized }

/// The length of a quaternion.
@inlinable public func simd_length<Q: SIMDQuaternion>(_ q: Q) -> Q.Scalar { q.length }

/// The dot product.
@inlinable public func simd_dot<Q: SIMDQuaternion>(_ p: Q, _ q: Q) -> Q.Scalar { dot(p, q) }

/// The dot product.
@inlinable public func dot<Q: SIMDQuaternion>(_ p: Q, _ q: Q) -> Q.Scalar {
  dot(p.vector, q.vector)
}

/// The angle of a rotation in radians.
@inlinable public func simd_angle<Q: SIMDQuaternion>(_ q: Q) -> Q.Scalar { q.angle }

/// The axis of a rotation.
@inlinable public func simd_axis<Q: SIMDQuaternion>(_ q: Q) -> SIMD3<Q.Scalar> { q.axis }

/// The real part of a quaternion.
@inlinable public func simd_real<Q: SIMDQuaternion>(_ q: Q) -> Q.Scalar { q.real }

/// The imaginary part of a quaternion.
@inlinable public func simd_imag<Q: SIMDQuaternion>(_ q: Q) -> SIMD3<Q.Scalar> { q.imag }

/// The rotation at `t` on the shorter arc from `q0` (0) to `q1` (1), at constant speed.
@inlinable public func simd_slerp<Q: SIMDQuaternion>(_ q0: Q, _ q1: Q, _ t: Q.Scalar) -> Q {
  arc(from: q0, to: dot(q0, q1) >= 0 ? q1 : -q1, t)
}

/// The rotation at `t` on the longer arc from `q0` (0) to `q1` (1), at constant speed.
@inlinable public func simd_slerp_longest<Q: SIMDQuaternion>(
  _ q0: Q, _ q1: Q, _ t: Q.Scalar
) -> Q { arc(from: q0, to: dot(q0, q1) >= 0 ? -q1 : q1, t) }

/// Spherical linear interpolation (Shoemake 1985). The angle by atan2 is accurate even where the
/// quaternions are nearly equal.
@inlinable func arc<Q: SIMDQuaternion>(from q0: Q, to q1: Q, _ t: Q.Scalar) -> Q {
  let angle = 2 * Q.Scalar.arcTangent(y: (q0 - q1).length, x: (q0 + q1).length)
  let sine = Q.Scalar.sine(of: angle)
  guard sine > Q.Scalar.ulpOfOne else { return (q0 * (1 - t) + q1 * t).normalized }
  let (part0, part1) = (Q.Scalar.sine(of: (1 - t) * angle), Q.Scalar.sine(of: t * angle))
  return (q0 * (part0 / sine) + q1 * (part1 / sine)).normalized
}
