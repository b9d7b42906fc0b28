// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A quaternion; of unit length it is a rotation. Not part of Apple's module: the protocol lets
/// `simd_quatf` and `simd_quatd` share one implementation.
public protocol SIMDQuaternion: Hashable, Codable, Sendable, CustomDebugStringConvertible {
  /// The type of the components.
  associatedtype Scalar: SIMDFloatingPoint

  /// The imaginary components x, y, z, then the real one.
  var vector: SIMD4<Scalar> { get set }

  /// Creates a quaternion from the imaginary components x, y, z and the real one.
  init(vector: SIMD4<Scalar>)
}

extension SIMDQuaternion {
  /// Creates the zero quaternion.
  @inlinable public init() { self.init(vector: .zero) }

  /// Creates a quaternion from its components.
  @inlinable public init(ix: Scalar, iy: Scalar, iz: Scalar, r: Scalar) {
    self.init(vector: [ix, iy, iz, r])
  }

  /// Creates a quaternion from its real and imaginary parts.
  @inlinable public init(real: Scalar, imag: SIMD3<Scalar>) {
    self.init(vector: SIMD4(imag, real))
  }

  /// Creates the rotation by `angle` radians about a unit vector, by the right-hand rule.
  @inlinable public init(angle: Scalar, axis: SIMD3<Scalar>) {
    self.init(
      vector: SIMD4(axis * Scalar.sine(of: angle / 2), Scalar.cosine(of: angle / 2)))
  }

  /// Creates the shortest rotation that turns the unit vector `from` to the unit vector `to`.
  @inlinable public init(from: SIMD3<Scalar>, to: SIMD3<Scalar>) {
    if dot(from, to) >= 0 {
      self.init(halfwayFrom: from, to: to)
      return
    }
    let sum = from + to
    // If the two are opposite, any axis perpendicular to them is valid.
    guard dot(sum, sum) > Scalar.ulpOfOne else {
      let magnitude = abs(from)
      let basis: SIMD3<Scalar> =
        magnitude.x <= magnitude.y && magnitude.x <= magnitude.z
        ? SIMD3(1, 0, 0) : (magnitude.y <= magnitude.z ? SIMD3(0, 1, 0) : SIMD3(0, 0, 1))
      self.init(real: 0, imag: normalize(cross(from, basis)))
      return
    }
    let half = normalize(sum)
    self = Self(halfwayFrom: half, to: to) * Self(halfwayFrom: from, to: half)
  }

  /// As above for vectors at most a right angle apart, where the half vector is well defined.
  @inlinable init(halfwayFrom from: SIMD3<Scalar>, to: SIMD3<Scalar>) {
    let half = normalize(from + to)
    self.init(real: dot(from, half), imag: cross(from, half))
  }

  /// Decodes the components in the order x, y, z, real.
  public init(from decoder: any Decoder) throws {
    self.init(vector: try decoder.singleValueContainer().decode(SIMD4<Scalar>.self))
  }

  /// Encodes the components in the order x, y, z, real.
  public func encode(to encoder: any Encoder) throws {
    var container = encoder.singleValueContainer()
    try container.encode(vector)
  }

  /// The real part.
  @inlinable public var real: Scalar {
    get { vector.w }
    set { vector.w = newValue }
  }

  /// The imaginary part.
  @inlinable public var imag: SIMD3<Scalar> {
    get { SIMD3(vector.x, vector.y, vector.z) }
    set { vector = SIMD4(newValue, vector.w) }
  }

  /// The angle of the rotation in radians, from 0 to 2π.
  @inlinable public var angle: Scalar { 2 * Scalar.arcTangent(y: simd.length(imag), x: real) }

  /// The axis of the rotation, a unit vector; NaN for the identity.
  @inlinable public var axis: SIMD3<Scalar> { normalize(imag) }

  /// The quaternion with the imaginary part negated.
  @inlinable public var conjugate: Self {
    Self(ix: -vector.x, iy: -vector.y, iz: -vector.z, r: vector.w)
  }

  /// The quaternion whose product with this one is 1.
  @inlinable public var inverse: Self { conjugate / dot(vector, vector) }

  /// The quaternion scaled to unit length.
  @inlinable public var normalized: Self { Self(vector: normalize(vector)) }

  /// The length.
  @inlinable public var length: Scalar { simd.length(vector) }

  /// Rotates a vector by this unit quaternion.
  @inlinable public func act(_ vector: SIMD3<Scalar>) -> SIMD3<Scalar> {
    let u = imag
    let t = cross(u, vector) * 2
    return vector + t * real + cross(u, t)
  }

  /// The name of the type, the real and the imaginary part, for debugging.
  public var debugDescription: String { "\(Self.self)(real: \(real), imag: \(imag))" }
}

extension SIMDQuaternion {
  /// The sum of two quaternions.
  @inlinable public static func + (lhs: Self, rhs: Self) -> Self {
    Self(vector: lhs.vector + rhs.vector)
  }

  /// The difference of two quaternions.
  @inlinable public static func - (lhs: Self, rhs: Self) -> Self {
    Self(vector: lhs.vector - rhs.vector)
  }

  /// The negated quaternion: the same rotation.
  @inlinable public static prefix func - (rhs: Self) -> Self { Self(vector: -rhs.vector) }

  /// The product (Hamilton): the rotation `rhs` followed by the rotation `lhs`.
  @inlinable public static func * (lhs: Self, rhs: Self) -> Self {
    let (u, v) = (lhs.imag, rhs.imag)
    let imag = v * lhs.real + u * rhs.real + cross(u, v)
    return Self(real: lhs.real * rhs.real - dot(u, v), imag: imag)
  }

  /// The quaternion multiplied by a scalar.
  @inlinable public static func * (lhs: Self, rhs: Scalar) -> Self {
    Self(vector: lhs.vector * rhs)
  }

  /// The quaternion multiplied by a scalar.
  @inlinable public static func * (lhs: Scalar, rhs: Self) -> Self {
    Self(vector: lhs * rhs.vector)
  }

  /// The product of `lhs` and the inverse of `rhs`.
  @inlinable public static func / (lhs: Self, rhs: Self) -> Self { lhs * rhs.inverse }

  /// The quaternion divided by a scalar.
  @inlinable public static func / (lhs: Self, rhs: Scalar) -> Self {
    Self(vector: lhs.vector / rhs)
  }

  /// Adds a quaternion.
  @inlinable public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a quaternion.
  @inlinable public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a quaternion on the right.
  @inlinable public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  @inlinable public static func *= (lhs: inout Self, rhs: Scalar) { lhs = lhs * rhs }

  /// Multiplies by the inverse of a quaternion on the right.
  @inlinable public static func /= (lhs: inout Self, rhs: Self) { lhs = lhs / rhs }

  /// Divides by a scalar.
  @inlinable public static func /= (lhs: inout Self, rhs: Scalar) { lhs = lhs / rhs }
}

/// A quaternion of 32-bit floating-point scalars; of unit length it is a rotation.
@frozen public struct simd_quatf: SIMDQuaternion {
  /// The type of the components.
  public typealias Scalar = Float

  /// The imaginary components x, y, z, then the real one.
  public var vector: simd_float4

  /// Creates a quaternion from the imaginary components x, y, z and the real one.
  @inlinable public init(vector: simd_float4) { self.vector = vector }
}

/// A quaternion of 64-bit floating-point scalars; of unit length it is a rotation.
@frozen public struct simd_quatd: SIMDQuaternion {
  /// The type of the components.
  public typealias Scalar = Double

  /// The imaginary components x, y, z, then the real one.
  public var vector: simd_double4

  /// Creates a quaternion from the imaginary components x, y, z and the real one.
  @inlinable public init(vector: simd_double4) { self.vector = vector }
}
