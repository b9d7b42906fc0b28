// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A matrix of four columns and four rows, stored by columns; not part of Apple's module.
public protocol SIMDMatrix4x4: SIMDMatrix where Column == SIMD4<Scalar> {
  /// The columns of the matrix.
  var columns: (Column, Column, Column, Column) { get set }

  /// Creates a matrix from its columns.
  init(columns: (Column, Column, Column, Column))
}

extension SIMDMatrix4x4 {
  /// Creates a matrix from its columns.
  @inlinable public init(
    _ column0: Column, _ column1: Column, _ column2: Column, _ column3: Column
  ) {
    self.init(columns: (column0, column1, column2, column3))
  }

  /// Creates a matrix from an array of four columns.
  @inlinable public init(_ columns: [Column]) {
    precondition(columns.count == 4, "a 4×4 matrix has four columns")
    self.init(columns[0], columns[1], columns[2], columns[3])
  }

  /// Creates a matrix with the vector on the main diagonal and zeros elsewhere.
  @inlinable public init(diagonal: Column) {
    self.init(
      [diagonal.x, 0, 0, 0], [0, diagonal.y, 0, 0], [0, 0, diagonal.z, 0], [0, 0, 0, diagonal.w])
  }

  /// The column with the given index.
  @inlinable public subscript(column: Int) -> Column {
    get {
      switch column {
      case 0: columns.0
      case 1: columns.1
      case 2: columns.2
      case 3: columns.3
      default: preconditionFailure("a 4×4 matrix has the columns 0 to 3")
      }
    }
    set {
      switch column {
      case 0: columns.0 = newValue
      case 1: columns.1 = newValue
      case 2: columns.2 = newValue
      case 3: columns.3 = newValue
      default: preconditionFailure("a 4×4 matrix has the columns 0 to 3")
      }
    }
  }

  /// The matrix with columns and rows exchanged.
  @inlinable public var transpose: Self {
    let m = columns
    return Self(
      Column(m.0.x, m.1.x, m.2.x, m.3.x), Column(m.0.y, m.1.y, m.2.y, m.3.y),
      Column(m.0.z, m.1.z, m.2.z, m.3.z), Column(m.0.w, m.1.w, m.2.w, m.3.w))
  }

  /// The 2×2 minors of the upper (s) and the lower (c) two rows, for Laplace's expansion.
  @inlinable var minors: (s: [Scalar], c: [Scalar]) {
    let m = columns
    let pairs = [(m.0, m.1), (m.0, m.2), (m.0, m.3), (m.1, m.2), (m.1, m.3), (m.2, m.3)]
    return (
      pairs.map { $0.x * $1.y - $1.x * $0.y }, pairs.map { $0.z * $1.w - $1.z * $0.w }
    )
  }

  /// The determinant.
  @inlinable public var determinant: Scalar {
    let (s, c) = minors
    let outer = s[0] * c[5] - s[1] * c[4] + s[2] * c[3]
    return outer + s[3] * c[2] - s[4] * c[1] + s[5] * c[0]
  }

  /// The inverse by the adjugate; not finite if the matrix is singular.
  @inlinable public var inverse: Self {
    let (s, c) = minors
    let scale = 1 / determinant
    /// A column of the adjugate from one row of the matrix and the opposite minors.
    func column(_ row: Column, _ k: [Scalar], _ sign: Scalar) -> Column {
      let x = row.y * k[5] - row.z * k[4] + row.w * k[3]
      let y = row.x * k[5] - row.z * k[2] + row.w * k[1]
      let z = row.x * k[4] - row.y * k[2] + row.w * k[0]
      let w = row.x * k[3] - row.y * k[1] + row.z * k[0]
      return Column(x, -y, z, -w) * (sign * scale)
    }
    let rows = transpose.columns
    return Self(
      column(rows.1, c, 1), column(rows.0, c, -1), column(rows.3, s, 1), column(rows.2, s, -1))
  }

  /// The sum of two matrices.
  @inlinable public static func + (lhs: Self, rhs: Self) -> Self {
    let (a, b) = (lhs.columns, rhs.columns)
    return Self(a.0 + b.0, a.1 + b.1, a.2 + b.2, a.3 + b.3)
  }

  /// The matrix multiplied by a scalar.
  @inlinable public static func * (lhs: Scalar, rhs: Self) -> Self {
    let m = rhs.columns
    return Self(lhs * m.0, lhs * m.1, lhs * m.2, lhs * m.3)
  }

  /// The product of a matrix and a column vector.
  @inlinable public static func * (lhs: Self, rhs: Column) -> Column {
    let m = lhs.columns
    return (m.0 * rhs.x + m.1 * rhs.y) + (m.2 * rhs.z + m.3 * rhs.w)
  }

  /// The product of two matrices.
  @inlinable public static func * (lhs: Self, rhs: Self) -> Self {
    let m = rhs.columns
    return Self(lhs * m.0, lhs * m.1, lhs * m.2, lhs * m.3)
  }

  /// Whether all elements are equal.
  @inlinable public static func == (lhs: Self, rhs: Self) -> Bool { lhs.columns == rhs.columns }

  /// Hashes the columns.
  @inlinable public func hash(into hasher: inout Hasher) {
    hasher.combine(columns.0)
    hasher.combine(columns.1)
    hasher.combine(columns.2)
    hasher.combine(columns.3)
  }
}

/// A matrix of four columns and four rows of 32-bit floating-point scalars, stored by columns.
@frozen public struct simd_float4x4: SIMDMatrix4x4 {
  /// The type of the elements.
  public typealias Scalar = Float

  /// The columns of the matrix.
  public var columns: (simd_float4, simd_float4, simd_float4, simd_float4)

  /// Creates a matrix from its columns.
  @inlinable public init(columns: (simd_float4, simd_float4, simd_float4, simd_float4)) {
    self.columns = columns
  }
}

/// A matrix of four columns and four rows of 64-bit floating-point scalars, stored by columns.
@frozen public struct simd_double4x4: SIMDMatrix4x4 {
  /// The type of the elements.
  public typealias Scalar = Double

  /// The columns of the matrix.
  public var columns: (simd_double4, simd_double4, simd_double4, simd_double4)

  /// Creates a matrix from its columns.
  @inlinable public init(columns: (simd_double4, simd_double4, simd_double4, simd_double4)) {
    self.columns = columns
  }
}

/// The short name of the type.
public typealias float4x4 = simd_float4x4
/// The name of the type in C.
public typealias matrix_float4x4 = simd_float4x4
/// The 4×4 identity matrix.
public let matrix_identity_float4x4 = simd_float4x4(1)
/// The short name of the type.
public typealias double4x4 = simd_double4x4
/// The name of the type in C.
public typealias matrix_double4x4 = simd_double4x4
/// The 4×4 identity matrix.
public let matrix_identity_double4x4 = simd_double4x4(1)

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_float4, _ column1: simd_float4, _ column2: simd_float4, _ column3: simd_float4
) -> simd_float4x4 {
  simd_float4x4(column0, column1, column2, column3)
}

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_double4, _ column1: simd_double4, _ column2: simd_double4,
  _ column3: simd_double4
) -> simd_double4x4 {
  simd_double4x4(column0, column1, column2, column3)
}
