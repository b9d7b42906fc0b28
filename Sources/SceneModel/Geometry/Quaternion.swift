import Foundation

/// A unit quaternion `x i + y j + z k + w` that represents a rotation.
///
/// Components are stored as x, y, z, w. COLMAP's text format has w first: only `Formats` converts.
package struct Quaternion: Hashable, Codable, Sendable {
  package var x: Double
  package var y: Double
  package var z: Double
  package var w: Double

  package init(x: Double, y: Double, z: Double, w: Double) {
    (self.x, self.y, self.z, self.w) = (x, y, z, w)
  }

  package static let identity = Quaternion(x: 0, y: 0, z: 0, w: 1)

  /// The rotation by `angle` radians about `axis`, counterclockwise when viewed against the axis.
  package init(angle: Double, axis: SIMD3<Double>) {
    let v = axis.normalized * sin(angle / 2)
    self.init(x: v.x, y: v.y, z: v.z, w: cos(angle / 2))
  }

  /// The rotation of a proper orthogonal matrix (Shepperd's method).
  package init(_ m: Matrix3) {
    let (d0, d1, d2) = (m.row0.x, m.row1.y, m.row2.z)
    let trace = d0 + d1 + d2
    if trace > 0 {
      let s = (trace + 1).squareRoot() * 2
      self.init(
        x: (m.row2.y - m.row1.z) / s, y: (m.row0.z - m.row2.x) / s,
        z: (m.row1.x - m.row0.y) / s, w: s / 4)
    } else if d0 > d1, d0 > d2 {
      let s = (1 + d0 - d1 - d2).squareRoot() * 2
      self.init(
        x: s / 4, y: (m.row0.y + m.row1.x) / s, z: (m.row0.z + m.row2.x) / s,
        w: (m.row2.y - m.row1.z) / s)
    } else if d1 > d2 {
      let s = (1 + d1 - d0 - d2).squareRoot() * 2
      self.init(
        x: (m.row0.y + m.row1.x) / s, y: s / 4, z: (m.row1.z + m.row2.y) / s,
        w: (m.row0.z - m.row2.x) / s)
    } else {
      let s = (1 + d2 - d0 - d1).squareRoot() * 2
      self.init(
        x: (m.row0.z + m.row2.x) / s, y: (m.row1.z + m.row2.y) / s, z: s / 4,
        w: (m.row1.x - m.row0.y) / s)
    }
    self = normalized
  }

  /// The quaternion of unit length; the identity for zero.
  package var normalized: Quaternion {
    let length = (x * x + y * y + z * z + w * w).squareRoot()
    return length > 0
      ? Quaternion(x: x / length, y: y / length, z: z / length, w: w / length) : .identity
  }

  /// The inverse rotation.
  package var conjugate: Quaternion { Quaternion(x: -x, y: -y, z: -z, w: w) }

  /// The angle of the rotation in radians, from 0 to π.
  package var angle: Double {
    2 * atan2((x * x + y * y + z * z).squareRoot(), abs(w))
  }

  /// The rotation `b` followed by the rotation `a`.
  package static func * (a: Quaternion, b: Quaternion) -> Quaternion {
    Quaternion(
      x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
      z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w,
      w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z)
  }

  /// Rotates a vector.
  package static func * (q: Quaternion, v: SIMD3<Double>) -> SIMD3<Double> {
    let u = SIMD3(q.x, q.y, q.z)
    let t = 2 * u.cross(v)
    return v + q.w * t + u.cross(t)
  }

  /// The rotation as a matrix.
  package var matrix: Matrix3 {
    Matrix3(
      rows: [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)])
  }
}
