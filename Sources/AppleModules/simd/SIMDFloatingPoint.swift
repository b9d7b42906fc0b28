import Foundation

/// The scalars of matrices and quaternions: `Float` and `Double`; not part of Apple's module.
public protocol SIMDFloatingPoint: SIMDScalar, FloatingPoint, Codable {
  /// The sine of an angle in radians.
  static func sine(of angle: Self) -> Self
  /// The cosine of an angle in radians.
  static func cosine(of angle: Self) -> Self
  /// The angle of the point (x, y) to the positive x axis in radians, from −π to π.
  static func arcTangent(y: Self, x: Self) -> Self
}

extension Float: SIMDFloatingPoint {
  /// The sine of an angle in radians.
  @inlinable public static func sine(of angle: Float) -> Float { sin(angle) }

  /// The cosine of an angle in radians.
  @inlinable public static func cosine(of angle: Float) -> Float { cos(angle) }

  /// The angle of the point (x, y) to the positive x axis in radians, from −π to π.
  @inlinable public static func arcTangent(y: Float, x: Float) -> Float { atan2(y, x) }
}

extension Double: SIMDFloatingPoint {
  /// The sine of an angle in radians.
  @inlinable public static func sine(of angle: Double) -> Double { sin(angle) }

  /// The cosine of an angle in radians.
  @inlinable public static func cosine(of angle: Double) -> Double { cos(angle) }

  /// The angle of the point (x, y) to the positive x axis in radians, from −π to π.
  @inlinable public static func arcTangent(y: Double, x: Double) -> Double { atan2(y, x) }
}
