// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A matrix of three columns and three rows, stored by columns; not part of Apple's module.
public protocol SIMDMatrix3x3: SIMDMatrix where Column == SIMD3<Scalar> {
  /// The columns of the matrix.
  var columns: (Column, Column, Column) { get set }

  /// Creates a matrix from its columns.
  init(columns: (Column, Column, Column))
}

extension SIMDMatrix3x3 {
  /// Creates a matrix from its columns.
  @inlinable public init(_ column0: Column, _ column1: Column, _ column2: Column) {
    self.init(columns: (column0, column1, column2))
  }

  /// Creates a matrix from an array of three columns.
  @inlinable public init(_ columns: [Column]) {
    precondition(columns.count == 3, "a 3×3 matrix has three columns")
    self.init(columns[0], columns[1], columns[2])
  }

  /// Creates a matrix with the vector on the main diagonal and zeros elsewhere.
  @inlinable public init(diagonal: Column) {
    self.init([diagonal.x, 0, 0], [0, diagonal.y, 0], [0, 0, diagonal.z])
  }

  /// The column with the given index.
  @inlinable public subscript(column: Int) -> Column {
    get {
      switch column {
      case 0: columns.0
      case 1: columns.1
      case 2: columns.2
      default: preconditionFailure("a 3×3 matrix has the columns 0, 1 and 2")
      }
    }
    set {
      switch column {
      case 0: columns.0 = newValue
      case 1: columns.1 = newValue
      case 2: columns.2 = newValue
      default: preconditionFailure("a 3×3 matrix has the columns 0, 1 and 2")
      }
    }
  }

  /// The matrix with columns and rows exchanged.
  @inlinable public var transpose: Self {
    let m = columns
    return Self(
      Column(m.0.x, m.1.x, m.2.x), Column(m.0.y, m.1.y, m.2.y), Column(m.0.z, m.1.z, m.2.z))
  }

  /// The inverse by the adjugate; not finite if the matrix is singular.
  @inlinable public var inverse: Self {
    let m = columns
    let rows = (cross(m.1, m.2), cross(m.2, m.0), cross(m.0, m.1))
    let scale = 1 / dot(m.0, rows.0)
    return Self(rows.0 * scale, rows.1 * scale, rows.2 * scale).transpose
  }

  /// The determinant.
  @inlinable public var determinant: Scalar { dot(columns.0, cross(columns.1, columns.2)) }

  /// The sum of two matrices.
  @inlinable public static func + (lhs: Self, rhs: Self) -> Self {
    let (a, b) = (lhs.columns, rhs.columns)
    return Self(a.0 + b.0, a.1 + b.1, a.2 + b.2)
  }

  /// The matrix multiplied by a scalar.
  @inlinable public static func * (lhs: Scalar, rhs: Self) -> Self {
    Self(lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2)
  }

  /// The product of a matrix and a column vector.
  @inlinable public static func * (lhs: Self, rhs: Column) -> Column {
    let m = lhs.columns
    return m.0 * rhs.x + m.1 * rhs.y + m.2 * rhs.z
  }

  /// The product of two matrices.
  @inlinable public static func * (lhs: Self, rhs: Self) -> Self {
    Self(lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2)
  }

  /// Whether all elements are equal.
  @inlinable public static func == (lhs: Self, rhs: Self) -> Bool { lhs.columns == rhs.columns }

  /// Hashes the columns.
  @inlinable public func hash(into hasher: inout Hasher) {
    hasher.combine(columns.0)
    hasher.combine(columns.1)
    hasher.combine(columns.2)
  }
}

/// A matrix of three columns and three rows of 32-bit floating-point scalars, stored by columns.
@frozen public struct simd_float3x3: SIMDMatrix3x3 {
  /// The type of the elements.
  public typealias Scalar = Float

  /// The columns of the matrix.
  public var columns: (simd_float3, simd_float3, simd_float3)

  /// Creates a matrix from its columns.
  @inlinable public init(columns: (simd_float3, simd_float3, simd_float3)) {
    self.columns = columns
  }
}

/// A matrix of three columns and three rows of 64-bit floating-point scalars, stored by columns.
@frozen public struct simd_double3x3: SIMDMatrix3x3 {
  /// The type of the elements.
  public typealias Scalar = Double

  /// The columns of the matrix.
  public var columns: (simd_double3, simd_double3, simd_double3)

  /// Creates a matrix from its columns.
  @inlinable public init(columns: (simd_double3, simd_double3, simd_double3)) {
    self.columns = columns
  }
}

/// The short name of the type.
public typealias float3x3 = simd_float3x3
/// The name of the type in C.
public typealias matrix_float3x3 = simd_float3x3
/// The 3×3 identity matrix.
public let matrix_identity_float3x3 = simd_float3x3(1)
/// The short name of the type.
public typealias double3x3 = simd_double3x3
/// The name of the type in C.
public typealias matrix_double3x3 = simd_double3x3
/// The 3×3 identity matrix.
public let matrix_identity_double3x3 = simd_double3x3(1)

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_float3, _ column1: simd_float3, _ column2: simd_float3
) -> simd_float3x3 {
  simd_float3x3(column0, column1, column2)
}

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_double3, _ column1: simd_double3, _ column2: simd_double3
) -> simd_double3x3 {
  simd_double3x3(column0, column1, column2)
}
