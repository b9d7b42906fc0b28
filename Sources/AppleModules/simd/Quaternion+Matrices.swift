// swift-format-ignore-file: AlwaysUseLowerCamelCase
// Conversions between quaternions and rotation matrices.

extension SIMDQuaternion {
  /// The rotation of a proper rotation matrix with the given columns (Shepperd 1978: divide by the
  /// largest component).
  @inlinable init(rotationColumns m: (SIMD3<Scalar>, SIMD3<Scalar>, SIMD3<Scalar>)) {
    let (d0, d1, d2) = (m.0.x, m.1.y, m.2.z)
    let trace = d0 + d1 + d2
    if trace >= 0 {
      let r = 2 * (1 + trace).squareRoot()
      self.init(
        ix: (m.1.z - m.2.y) / r, iy: (m.2.x - m.0.z) / r, iz: (m.0.y - m.1.x) / r, r: r / 4)
    } else if d0 >= d1, d0 >= d2 {
      let r = 2 * (1 - d1 - d2 + d0).squareRoot()
      self.init(
        ix: r / 4, iy: (m.0.y + m.1.x) / r, iz: (m.0.z + m.2.x) / r, r: (m.1.z - m.2.y) / r)
    } else if d1 >= d2 {
      let r = 2 * (1 - d0 - d2 + d1).squareRoot()
      self.init(
        ix: (m.0.y + m.1.x) / r, iy: r / 4, iz: (m.1.z + m.2.y) / r, r: (m.2.x - m.0.z) / r)
    } else {
      let r = 2 * (1 - d0 - d1 + d2).squareRoot()
      self.init(
        ix: (m.0.z + m.2.x) / r, iy: (m.1.z + m.2.y) / r, iz: r / 4, r: (m.0.y - m.1.x) / r)
    }
  }

  /// The rotation of the upper left 3×3 part of a transformation matrix.
  @inlinable init<M: SIMDMatrix4x4>(upperLeftOf matrix: M) where M.Scalar == Scalar {
    func upper(_ column: SIMD4<Scalar>) -> SIMD3<Scalar> { SIMD3(column.x, column.y, column.z) }
    let m = matrix.columns
    self.init(rotationColumns: (upper(m.0), upper(m.1), upper(m.2)))
  }

  /// The columns of the rotation matrix of a unit quaternion.
  @inlinable var rotationColumns: (SIMD3<Scalar>, SIMD3<Scalar>, SIMD3<Scalar>) {
    let (x, y, z, w) = (vector.x, vector.y, vector.z, vector.w)
    let (xx, yy, zz) = (x * x, y * y, z * z)
    return (
      SIMD3(1 - 2 * (yy + zz), 2 * (x * y + z * w), 2 * (x * z - y * w)),
      SIMD3(2 * (x * y - z * w), 1 - 2 * (xx + zz), 2 * (y * z + x * w)),
      SIMD3(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (xx + yy))
    )
  }
}

extension SIMDMatrix4x4 {
  /// The transformation matrix with the given rotation and no translation.
  @inlinable init(rotationColumns m: (SIMD3<Scalar>, SIMD3<Scalar>, SIMD3<Scalar>)) {
    self.init(Column(m.0, 0), Column(m.1, 0), Column(m.2, 0), [0, 0, 0, 1])
  }
}

extension simd_quatf {
  /// Creates the rotation of a rotation matrix.
  @inlinable public init(_ rotationMatrix: simd_float3x3) {
    self.init(rotationColumns: rotationMatrix.columns)
  }

  /// Creates the rotation of the upper left 3×3 part of a transformation matrix.
  @inlinable public init(_ rotationMatrix: simd_float4x4) {
    self.init(upperLeftOf: rotationMatrix)
  }
}

extension simd_quatd {
  /// Creates the rotation of a rotation matrix.
  @inlinable public init(_ rotationMatrix: simd_double3x3) {
    self.init(rotationColumns: rotationMatrix.columns)
  }

  /// Creates the rotation of the upper left 3×3 part of a transformation matrix.
  @inlinable public init(_ rotationMatrix: simd_double4x4) {
    self.init(upperLeftOf: rotationMatrix)
  }
}

extension simd_float3x3 {
  /// Creates the rotation matrix of a unit quaternion.
  @inlinable public init(_ quaternion: simd_quatf) {
    self.init(columns: quaternion.rotationColumns)
  }
}

extension simd_double3x3 {
  /// Creates the rotation matrix of a unit quaternion.
  @inlinable public init(_ quaternion: simd_quatd) {
    self.init(columns: quaternion.rotationColumns)
  }
}

extension simd_float4x4 {
  /// Creates the rotation matrix of a unit quaternion.
  @inlinable public init(_ quaternion: simd_quatf) {
    self.init(rotationColumns: quaternion.rotationColumns)
  }
}

extension simd_double4x4 {
  /// Creates the rotation matrix of a unit quaternion.
  @inlinable public init(_ quaternion: simd_quatd) {
    self.init(rotationColumns: quaternion.rotationColumns)
  }
}

/// Makes the rotation of a rotation matrix.
public func simd_quaternion(_ matrix: simd_float3x3) -> simd_quatf { simd_quatf(matrix) }

/// Makes the rotation of a rotation matrix.
public func simd_quaternion(_ matrix: simd_double3x3) -> simd_quatd { simd_quatd(matrix) }

/// Makes the rotation of the upper left part of a transformation matrix.
public func simd_quaternion(_ matrix: simd_float4x4) -> simd_quatf { simd_quatf(matrix) }

/// Makes the rotation of the upper left part of a transformation matrix.
public func simd_quaternion(_ matrix: simd_double4x4) -> simd_quatd { simd_quatd(matrix) }

/// The rotation matrix of a unit quaternion.
public func simd_matrix3x3(_ q: simd_quatf) -> simd_float3x3 { simd_float3x3(q) }

/// The rotation matrix of a unit quaternion.
public func simd_matrix3x3(_ q: simd_quatd) -> simd_double3x3 { simd_double3x3(q) }

/// The transformation matrix of a unit quaternion.
public func simd_matrix4x4(_ q: simd_quatf) -> simd_float4x4 { simd_float4x4(q) }

/// The transformation matrix of a unit quaternion.
public func simd_matrix4x4(_ q: simd_quatd) -> simd_double4x4 { simd_double4x4(q) }
