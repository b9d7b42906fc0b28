import Foundation
import SceneModel

extension SplitMix64 {
  /// A number in `-size..<size`.
  mutating func number(_ size: Double = 1) -> Double { size * (2 * uniform() - 1) }

  /// A vector with components in `-size..<size`.
  mutating func vector(_ size: Double = 1) -> SIMD3<Double> {
    let (x, y, z) = (number(size), number(size), number(size))
    return [x, y, z]
  }

  /// A rotation by 0 to π about any axis.
  mutating func rotation() -> Quaternion {
    Quaternion(angle: .pi * uniform(), axis: vector() + [0, 0, 2])
  }

  mutating func rigidTransform() -> RigidTransform {
    RigidTransform(rotation: rotation(), translation: vector(10))
  }
}

/// The largest difference of two matrices' elements.
func difference(_ a: Matrix3, _ b: Matrix3) -> Double {
  zip(a.elements, b.elements).map { abs($0 - $1) }.max() ?? 0
}
