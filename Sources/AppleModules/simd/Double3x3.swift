// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A matrix of three columns and three rows of 64-bit floating-point scalars, stored by columns.
public struct simd_double3x3: Hashable, Sendable {
  /// The columns of the matrix.
  public var columns: (simd_double3, simd_double3, simd_double3)

  /// Creates a matrix of zeros.
  public init() { columns = (.zero, .zero, .zero) }

  /// Creates a matrix from its columns.
  public init(columns: (simd_double3, simd_double3, simd_double3)) { self.columns = columns }

  /// Creates a matrix from its columns.
  public init(_ column0: simd_double3, _ column1: simd_double3, _ column2: simd_double3) {
    columns = (column0, column1, column2)
  }

  /// Creates a matrix from an array of three columns.
  public init(_ columns: [simd_double3]) {
    precondition(columns.count == 3, "a 3×3 matrix has three columns")
    self.init(columns[0], columns[1], columns[2])
  }

  /// Creates a matrix from an array of three rows.
  public init(rows: [simd_double3]) { self = simd_double3x3(rows).transpose }

  /// Creates a matrix with the vector on the main diagonal and zeros elsewhere.
  public init(diagonal: simd_double3) {
    columns = ([diagonal.x, 0, 0], [0, diagonal.y, 0], [0, 0, diagonal.z])
  }

  /// Creates a matrix with the scalar on the main diagonal and zeros elsewhere.
  public init(_ scalar: Double) { self.init(diagonal: simd_double3(repeating: scalar)) }

  /// Creates the rotation matrix of a unit quaternion.
  public init(_ quaternion: simd_quatd) { columns = rotationColumns(quaternion.vector) }

  /// The column with the given index.
  public subscript(column: Int) -> simd_double3 {
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

  /// The element in the given column and row.
  public subscript(column: Int, row: Int) -> Double {
    get { self[column][row] }
    set { self[column][row] = newValue }
  }

  /// The matrix with columns and rows exchanged.
  public var transpose: simd_double3x3 { simd_double3x3(columns: transposed(columns)) }

  /// The inverse; not finite if the matrix is singular.
  public var inverse: simd_double3x3 { simd_double3x3(columns: inverted(columns)) }

  /// The determinant.
  public var determinant: Double { simd.determinant(columns) }

  /// Whether all elements are equal.
  public static func == (lhs: Self, rhs: Self) -> Bool { lhs.columns == rhs.columns }

  /// Hashes the columns.
  public func hash(into hasher: inout Hasher) {
    hasher.combine(columns.0)
    hasher.combine(columns.1)
    hasher.combine(columns.2)
  }
}

extension simd_double3x3: CustomDebugStringConvertible {
  /// The columns, for debugging.
  public var debugDescription: String {
    let texts = (0..<3).map { column in
      "[" + (0..<3).map { self[column][$0].description }.joined(separator: ", ") + "]"
    }
    return "simd_double3x3([" + texts.joined(separator: ", ") + "])"
  }
}

extension simd_double3x3 {
  /// The sum of two matrices.
  public static func + (lhs: Self, rhs: Self) -> Self {
    Self(
      lhs.columns.0 + rhs.columns.0, lhs.columns.1 + rhs.columns.1,
      lhs.columns.2 + rhs.columns.2)
  }

  /// The difference of two matrices.
  public static func - (lhs: Self, rhs: Self) -> Self { lhs + -rhs }

  /// The negated matrix.
  public static prefix func - (matrix: Self) -> Self { -1 * matrix }

  /// The matrix multiplied by a scalar.
  public static func * (lhs: Double, rhs: Self) -> Self {
    Self(lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2)
  }

  /// The matrix multiplied by a scalar.
  public static func * (lhs: Self, rhs: Double) -> Self { rhs * lhs }

  /// The product of a matrix and a column vector.
  public static func * (lhs: Self, rhs: simd_double3) -> simd_double3 { product(lhs.columns, rhs) }

  /// The product of a row vector and a matrix.
  public static func * (lhs: simd_double3, rhs: Self) -> simd_double3 {
    product(transposed(rhs.columns), lhs)
  }

  /// The product of two matrices.
  public static func * (lhs: Self, rhs: Self) -> Self {
    Self(lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2)
  }

  /// Adds a matrix.
  public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a matrix.
  public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a matrix on the right.
  public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  public static func *= (lhs: inout Self, rhs: Double) { lhs = lhs * rhs }
}

/// The short name of the type.
public typealias double3x3 = simd_double3x3
/// The name of the type in C.
public typealias matrix_double3x3 = simd_double3x3
/// The 3×3 identity matrix.
public let matrix_identity_double3x3 = simd_double3x3(1)

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_double3, _ column1: simd_double3, _ column2: simd_double3
) -> simd_double3x3 {
  simd_double3x3(column0, column1, column2)
}

/// The product of two matrices.
public func simd_mul(_ x: simd_double3x3, _ y: simd_double3x3) -> simd_double3x3 { x * y }

/// The product of a matrix and a column vector.
public func simd_mul(_ x: simd_double3x3, _ y: simd_double3) -> simd_double3 { x * y }

/// The inverse of a matrix.
public func simd_inverse(_ x: simd_double3x3) -> simd_double3x3 { x.inverse }

/// The transpose of a matrix.
public func simd_transpose(_ x: simd_double3x3) -> simd_double3x3 { x.transpose }

/// The determinant of a matrix.
public func simd_determinant(_ x: simd_double3x3) -> Double { x.determinant }

/// Whether corresponding elements differ by no more than `tolerance`.
public func simd_almost_equal_elements(
  _ x: simd_double3x3, _ y: simd_double3x3, _ tolerance: Double
) -> Bool {
  (0..<3).allSatisfy { norm_inf(x[$0] - y[$0]) <= tolerance }
}
