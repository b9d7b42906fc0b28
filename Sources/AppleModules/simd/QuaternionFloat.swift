// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized
import Foundation

/// A quaternion of 32-bit floating-point scalars; of unit length it is a rotation.
public struct simd_quatf: Hashable, Codable, Sendable {
  /// The imaginary components x, y, z, then the real one.
  public var vector: simd_float4

  /// Creates the zero quaternion.
  public init() { vector = .zero }

  /// Creates a quaternion from the imaginary components x, y, z and the real one.
  public init(vector: simd_float4) { self.vector = vector }

  /// Creates a quaternion from its components.
  public init(ix: Float, iy: Float, iz: Float, r: Float) { vector = [ix, iy, iz, r] }

  /// Creates a quaternion from its real and imaginary parts.
  public init(real: Float, imag: simd_float3) { vector = simd_float4(imag, real) }

  /// Creates the rotation by `angle` radians about a unit vector, by the right-hand rule.
  public init(angle: Float, axis: simd_float3) {
    vector = simd_float4(axis * sin(angle / 2), cos(angle / 2))
  }

  /// Creates the shortest rotation that turns the unit vector `from` to the unit vector `to`.
  public init(from: simd_float3, to: simd_float3) { vector = quaternion(turning: from, to: to) }

  /// Creates the rotation of a rotation matrix.
  public init(_ rotationMatrix: simd_float3x3) {
    vector = quaternion(ofRotation: rotationMatrix.columns)
  }

  /// Creates the rotation of the upper left 3×3 part of a transformation matrix.
  public init(_ rotationMatrix: simd_float4x4) {
    let m = rotationMatrix.columns
    vector = quaternion(ofRotation: (imaginary(m.0), imaginary(m.1), imaginary(m.2)))
  }

  /// Decodes the components in the order x, y, z, real.
  public init(from decoder: any Decoder) throws {
    vector = try decoder.singleValueContainer().decode(simd_float4.self)
  }

  /// Encodes the components in the order x, y, z, real.
  public func encode(to encoder: any Encoder) throws {
    var container = encoder.singleValueContainer()
    try container.encode(vector)
  }

  /// The real part.
  public var real: Float {
    get { vector.w }
    set { vector.w = newValue }
  }

  /// The imaginary part.
  public var imag: simd_float3 {
    get { imaginary(vector) }
    set { vector = simd_float4(newValue, vector.w) }
  }

  /// The angle of the rotation in radians, from 0 to 2π.
  public var angle: Float { 2 * atan2(simd.length(imag), real) }

  /// The axis of the rotation, a unit vector; NaN for the identity.
  public var axis: simd_float3 { normalize(imag) }

  /// The quaternion with the imaginary part negated.
  public var conjugate: simd_quatf { simd_quatf(vector: conjugated(vector)) }

  /// The quaternion whose product with this one is 1.
  public var inverse: simd_quatf { simd_quatf(vector: conjugated(vector) / dot(vector, vector)) }

  /// The quaternion scaled to unit length.
  public var normalized: simd_quatf { simd_quatf(vector: normalize(vector)) }

  /// The length.
  public var length: Float { simd.length(vector) }

  /// Rotates a vector by this unit quaternion.
  public func act(_ vector: simd_float3) -> simd_float3 { rotated(vector, by: self.vector) }
}

extension simd_quatf: CustomDebugStringConvertible {
  /// The real and imaginary parts, for debugging.
  public var debugDescription: String { "simd_quatf(real: \(real), imag: \(imag))" }
}

extension simd_quatf {
  /// The sum of two quaternions.
  public static func + (lhs: Self, rhs: Self) -> Self { Self(vector: lhs.vector + rhs.vector) }

  /// The difference of two quaternions.
  public static func - (lhs: Self, rhs: Self) -> Self { Self(vector: lhs.vector - rhs.vector) }

  /// The negated quaternion: the same rotation.
  public static prefix func - (rhs: Self) -> Self { Self(vector: -rhs.vector) }

  /// The product: the rotation `rhs` followed by the rotation `lhs`.
  public static func * (lhs: Self, rhs: Self) -> Self {
    Self(vector: hamiltonProduct(lhs.vector, rhs.vector))
  }

  /// The quaternion multiplied by a scalar.
  public static func * (lhs: Self, rhs: Float) -> Self { Self(vector: lhs.vector * rhs) }

  /// The quaternion multiplied by a scalar.
  public static func * (lhs: Float, rhs: Self) -> Self { Self(vector: lhs * rhs.vector) }

  /// The product of `lhs` and the inverse of `rhs`.
  public static func / (lhs: Self, rhs: Self) -> Self { lhs * rhs.inverse }

  /// The quaternion divided by a scalar.
  public static func / (lhs: Self, rhs: Float) -> Self { Self(vector: lhs.vector / rhs) }

  /// Adds a quaternion.
  public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a quaternion.
  public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a quaternion on the right.
  public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  public static func *= (lhs: inout Self, rhs: Float) { lhs = lhs * rhs }

  /// Multiplies by the inverse of a quaternion on the right.
  public static func /= (lhs: inout Self, rhs: Self) { lhs = lhs / rhs }

  /// Divides by a scalar.
  public static func /= (lhs: inout Self, rhs: Float) { lhs = lhs / rhs }
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ ix: Float, _ iy: Float, _ iz: Float, _ r: Float) -> simd_quatf {
  simd_quatf(ix: ix, iy: iy, iz: iz, r: r)
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ xyzr: simd_float4) -> simd_quatf { simd_quatf(vector: xyzr) }

/// Makes the rotation by `angle` radians about a unit vector.
public func simd_quaternion(_ angle: Float, _ axis: simd_float3) -> simd_quatf {
  simd_quatf(angle: angle, axis: axis)
}

/// Makes the shortest rotation that turns one unit vector to another.
public func simd_quaternion(_ from: simd_float3, _ to: simd_float3) -> simd_quatf {
  simd_quatf(from: from, to: to)
}

/// Makes the rotation of a rotation matrix.
public func simd_quaternion(_ matrix: simd_float3x3) -> simd_quatf { simd_quatf(matrix) }

/// Makes the rotation of the upper left part of a transformation matrix.
public func simd_quaternion(_ matrix: simd_float4x4) -> simd_quatf { simd_quatf(matrix) }

/// The rotation matrix of a unit quaternion.
public func simd_matrix3x3(_ q: simd_quatf) -> simd_float3x3 { simd_float3x3(q) }

/// The transformation matrix of a unit quaternion.
public func simd_matrix4x4(_ q: simd_quatf) -> simd_float4x4 { simd_float4x4(q) }

/// The product: the rotation `q` followed by the rotation `p`.
public func simd_mul(_ p: simd_quatf, _ q: simd_quatf) -> simd_quatf { p * q }

/// Rotates a vector by a unit quaternion.
public func simd_act(_ q: simd_quatf, _ v: simd_float3) -> simd_float3 { q.act(v) }

/// The quaternion whose product with `q` is 1.
public func simd_inverse(_ q: simd_quatf) -> simd_quatf { q.inverse }

/// The quaternion with the imaginary part negated.
public func simd_conjugate(_ q: simd_quatf) -> simd_quatf { q.conjugate }

/// The quaternion scaled to unit length.
public func simd_normalize(_ q: simd_quatf) -> simd_quatf { q.normalized }

/// The length of a quaternion.
public func simd_length(_ q: simd_quatf) -> Float { q.length }

/// The dot product.
public func simd_dot(_ p: simd_quatf, _ q: simd_quatf) -> Float { dot(p.vector, q.vector) }

/// The dot product.
public func dot(_ p: simd_quatf, _ q: simd_quatf) -> Float { dot(p.vector, q.vector) }

/// The angle of a rotation in radians.
public func simd_angle(_ q: simd_quatf) -> Float { q.angle }

/// The axis of a rotation.
public func simd_axis(_ q: simd_quatf) -> simd_float3 { q.axis }

/// The real part of a quaternion.
public func simd_real(_ q: simd_quatf) -> Float { q.real }

/// The imaginary part of a quaternion.
public func simd_imag(_ q: simd_quatf) -> simd_float3 { q.imag }

/// The rotation at `t` on the shorter arc from `q0` (0) to `q1` (1), at constant speed.
public func simd_slerp(_ q0: simd_quatf, _ q1: simd_quatf, _ t: Float) -> simd_quatf {
  arc(from: q0, to: dot(q0, q1) >= 0 ? q1 : -q1, t)
}

/// The rotation at `t` on the longer arc from `q0` (0) to `q1` (1), at constant speed.
public func simd_slerp_longest(_ q0: simd_quatf, _ q1: simd_quatf, _ t: Float) -> simd_quatf {
  arc(from: q0, to: dot(q0, q1) >= 0 ? -q1 : q1, t)
}

private func arc(from q0: simd_quatf, to q1: simd_quatf, _ t: Float) -> simd_quatf {
  // Shoemake 1985; the atan2 form of the angle stays exact where the quaternions nearly agree.
  let angle = 2 * atan2((q0 - q1).length, (q0 + q1).length)
  let sine = sin(angle)
  guard sine > Float.ulpOfOne else { return (q0 * (1 - t) + q1 * t).normalized }
  return (q0 * (sin((1 - t) * angle) / sine) + q1 * (sin(t * angle) / sine)).normalized
}
