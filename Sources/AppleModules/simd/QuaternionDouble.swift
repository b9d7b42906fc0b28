// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized
import Foundation

/// A quaternion of 64-bit floating-point scalars; of unit length it is a rotation.
public struct simd_quatd: Hashable, Codable, Sendable {
  /// The imaginary components x, y, z, then the real one.
  public var vector: simd_double4

  /// Creates the zero quaternion.
  public init() { vector = .zero }

  /// Creates a quaternion from the imaginary components x, y, z and the real one.
  public init(vector: simd_double4) { self.vector = vector }

  /// Creates a quaternion from its components.
  public init(ix: Double, iy: Double, iz: Double, r: Double) { vector = [ix, iy, iz, r] }

  /// Creates a quaternion from its real and imaginary parts.
  public init(real: Double, imag: simd_double3) { vector = simd_double4(imag, real) }

  /// Creates the rotation by `angle` radians about a unit vector, by the right-hand rule.
  public init(angle: Double, axis: simd_double3) {
    vector = simd_double4(axis * sin(angle / 2), cos(angle / 2))
  }

  /// Creates the shortest rotation that turns the unit vector `from` to the unit vector `to`.
  public init(from: simd_double3, to: simd_double3) { vector = quaternion(turning: from, to: to) }

  /// Creates the rotation of a rotation matrix.
  public init(_ rotationMatrix: simd_double3x3) {
    vector = quaternion(ofRotation: rotationMatrix.columns)
  }

  /// Creates the rotation of the upper left 3×3 part of a transformation matrix.
  public init(_ rotationMatrix: simd_double4x4) {
    let m = rotationMatrix.columns
    vector = quaternion(ofRotation: (imaginary(m.0), imaginary(m.1), imaginary(m.2)))
  }

  /// Decodes the components in the order x, y, z, real.
  public init(from decoder: any Decoder) throws {
    vector = try decoder.singleValueContainer().decode(simd_double4.self)
  }

  /// Encodes the components in the order x, y, z, real.
  public func encode(to encoder: any Encoder) throws {
    var container = encoder.singleValueContainer()
    try container.encode(vector)
  }

  /// The real part.
  public var real: Double {
    get { vector.w }
    set { vector.w = newValue }
  }

  /// The imaginary part.
  public var imag: simd_double3 {
    get { imaginary(vector) }
    set { vector = simd_double4(newValue, vector.w) }
  }

  /// The angle of the rotation in radians, from 0 to 2π.
  public var angle: Double { 2 * atan2(simd.length(imag), real) }

  /// The axis of the rotation, a unit vector; NaN for the identity.
  public var axis: simd_double3 { normalize(imag) }

  /// The quaternion with the imaginary part negated.
  public var conjugate: simd_quatd { simd_quatd(vector: conjugated(vector)) }

  /// The quaternion whose product with this one is 1.
  public var inverse: simd_quatd { simd_quatd(vector: conjugated(vector) / dot(vector, vector)) }

  /// The quaternion scaled to unit length.
  public var normalized: simd_quatd { simd_quatd(vector: normalize(vector)) }

  /// The length.
  public var length: Double { simd.length(vector) }

  /// Rotates a vector by this unit quaternion.
  public func act(_ vector: simd_double3) -> simd_double3 { rotated(vector, by: self.vector) }
}

extension simd_quatd: CustomDebugStringConvertible {
  /// The real and imaginary parts, for debugging.
  public var debugDescription: String { "simd_quatd(real: \(real), imag: \(imag))" }
}

extension simd_quatd {
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
  public static func * (lhs: Self, rhs: Double) -> Self { Self(vector: lhs.vector * rhs) }

  /// The quaternion multiplied by a scalar.
  public static func * (lhs: Double, rhs: Self) -> Self { Self(vector: lhs * rhs.vector) }

  /// The product of `lhs` and the inverse of `rhs`.
  public static func / (lhs: Self, rhs: Self) -> Self { lhs * rhs.inverse }

  /// The quaternion divided by a scalar.
  public static func / (lhs: Self, rhs: Double) -> Self { Self(vector: lhs.vector / rhs) }

  /// Adds a quaternion.
  public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a quaternion.
  public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a quaternion on the right.
  public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  public static func *= (lhs: inout Self, rhs: Double) { lhs = lhs * rhs }

  /// Multiplies by the inverse of a quaternion on the right.
  public static func /= (lhs: inout Self, rhs: Self) { lhs = lhs / rhs }

  /// Divides by a scalar.
  public static func /= (lhs: inout Self, rhs: Double) { lhs = lhs / rhs }
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ ix: Double, _ iy: Double, _ iz: Double, _ r: Double) -> simd_quatd {
  simd_quatd(ix: ix, iy: iy, iz: iz, r: r)
}

/// Makes a quaternion from the imaginary components x, y, z and the real one.
public func simd_quaternion(_ xyzr: simd_double4) -> simd_quatd { simd_quatd(vector: xyzr) }

/// Makes the rotation by `angle` radians about a unit vector.
public func simd_quaternion(_ angle: Double, _ axis: simd_double3) -> simd_quatd {
  simd_quatd(angle: angle, axis: axis)
}

/// Makes the shortest rotation that turns one unit vector to another.
public func simd_quaternion(_ from: simd_double3, _ to: simd_double3) -> simd_quatd {
  simd_quatd(from: from, to: to)
}

/// Makes the rotation of a rotation matrix.
public func simd_quaternion(_ matrix: simd_double3x3) -> simd_quatd { simd_quatd(matrix) }

/// Makes the rotation of the upper left part of a transformation matrix.
public func simd_quaternion(_ matrix: simd_double4x4) -> simd_quatd { simd_quatd(matrix) }

/// The rotation matrix of a unit quaternion.
public func simd_matrix3x3(_ q: simd_quatd) -> simd_double3x3 { simd_double3x3(q) }

/// The transformation matrix of a unit quaternion.
public func simd_matrix4x4(_ q: simd_quatd) -> simd_double4x4 { simd_double4x4(q) }

/// The product: the rotation `q` followed by the rotation `p`.
public func simd_mul(_ p: simd_quatd, _ q: simd_quatd) -> simd_quatd { p * q }

/// Rotates a vector by a unit quaternion.
public func simd_act(_ q: simd_quatd, _ v: simd_double3) -> simd_double3 { q.act(v) }

/// The quaternion whose product with `q` is 1.
public func simd_inverse(_ q: simd_quatd) -> simd_quatd { q.inverse }

/// The quaternion with the imaginary part negated.
public func simd_conjugate(_ q: simd_quatd) -> simd_quatd { q.conjugate }

/// The quaternion scaled to unit length.
public func simd_normalize(_ q: simd_quatd) -> simd_quatd { q.normalized }

/// The length of a quaternion.
public func simd_length(_ q: simd_quatd) -> Double { q.length }

/// The dot product.
public func simd_dot(_ p: simd_quatd, _ q: simd_quatd) -> Double { dot(p.vector, q.vector) }

/// The dot product.
public func dot(_ p: simd_quatd, _ q: simd_quatd) -> Double { dot(p.vector, q.vector) }

/// The angle of a rotation in radians.
public func simd_angle(_ q: simd_quatd) -> Double { q.angle }

/// The axis of a rotation.
public func simd_axis(_ q: simd_quatd) -> simd_double3 { q.axis }

/// The real part of a quaternion.
public func simd_real(_ q: simd_quatd) -> Double { q.real }

/// The imaginary part of a quaternion.
public func simd_imag(_ q: simd_quatd) -> simd_double3 { q.imag }

/// The rotation at `t` on the shorter arc from `q0` (0) to `q1` (1), at constant speed.
public func simd_slerp(_ q0: simd_quatd, _ q1: simd_quatd, _ t: Double) -> simd_quatd {
  arc(from: q0, to: dot(q0, q1) >= 0 ? q1 : -q1, t)
}

/// The rotation at `t` on the longer arc from `q0` (0) to `q1` (1), at constant speed.
public func simd_slerp_longest(_ q0: simd_quatd, _ q1: simd_quatd, _ t: Double) -> simd_quatd {
  arc(from: q0, to: dot(q0, q1) >= 0 ? -q1 : q1, t)
}

private func arc(from q0: simd_quatd, to q1: simd_quatd, _ t: Double) -> simd_quatd {
  // Shoemake 1985; the atan2 form of the angle stays exact where the quaternions nearly agree.
  let angle = 2 * atan2((q0 - q1).length, (q0 + q1).length)
  let sine = sin(angle)
  guard sine > Double.ulpOfOne else { return (q0 * (1 - t) + q1 * t).normalized }
  return (q0 * (sin((1 - t) * angle) / sine) + q1 * (sin(t * angle) / sine)).normalized
}
