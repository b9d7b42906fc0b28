// swift-format-ignore-file: AlwaysUseLowerCamelCase, TypeNamesShouldBeCapitalized

/// A matrix of four columns and four rows of 32-bit floating-point scalars, stored by columns.
public struct simd_float4x4: Hashable, Sendable {
  /// The columns of the matrix.
  public var columns: (simd_float4, simd_float4, simd_float4, simd_float4)

  /// Creates a matrix of zeros.
  public init() { columns = (.zero, .zero, .zero, .zero) }

  /// Creates a matrix from its columns.
  public init(columns: (simd_float4, simd_float4, simd_float4, simd_float4)) {
    self.columns = columns
  }

  /// Creates a matrix from its columns.
  public init(
    _ column0: simd_float4, _ column1: simd_float4, _ column2: simd_float4, _ column3: simd_float4
  ) {
    columns = (column0, column1, column2, column3)
  }

  /// Creates a matrix from an array of four columns.
  public init(_ columns: [simd_float4]) {
    precondition(columns.count == 4, "a 4×4 matrix has four columns")
    self.init(columns[0], columns[1], columns[2], columns[3])
  }

  /// Creates a matrix from an array of four rows.
  public init(rows: [simd_float4]) { self = simd_float4x4(rows).transpose }

  /// Creates a matrix with the vector on the main diagonal and zeros elsewhere.
  public init(diagonal: simd_float4) {
    columns = (
      [diagonal.x, 0, 0, 0], [0, diagonal.y, 0, 0], [0, 0, diagonal.z, 0], [0, 0, 0, diagonal.w]
    )
  }

  /// Creates a matrix with the scalar on the main diagonal and zeros elsewhere.
  public init(_ scalar: Float) { self.init(diagonal: simd_float4(repeating: scalar)) }

  /// Creates the rotation matrix of a unit quaternion.
  public init(_ quaternion: simd_quatf) {
    let rotation = rotationColumns(quaternion.vector)
    columns = (
      simd_float4(rotation.0, 0), simd_float4(rotation.1, 0), simd_float4(rotation.2, 0),
      [0, 0, 0, 1]
    )
  }

  /// The column with the given index.
  public subscript(column: Int) -> simd_float4 {
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

  /// The element in the given column and row.
  public subscript(column: Int, row: Int) -> Float {
    get { self[column][row] }
    set { self[column][row] = newValue }
  }

  /// The matrix with columns and rows exchanged.
  public var transpose: simd_float4x4 { simd_float4x4(columns: transposed(columns)) }

  /// The inverse; not finite if the matrix is singular.
  public var inverse: simd_float4x4 { simd_float4x4(columns: inverted(columns)) }

  /// The determinant.
  public var determinant: Float { simd.determinant(columns) }

  /// Whether all elements are equal.
  public static func == (lhs: Self, rhs: Self) -> Bool { lhs.columns == rhs.columns }

  /// Hashes the columns.
  public func hash(into hasher: inout Hasher) {
    hasher.combine(columns.0)
    hasher.combine(columns.1)
    hasher.combine(columns.2)
    hasher.combine(columns.3)
  }
}

extension simd_float4x4: CustomDebugStringConvertible {
  /// The columns, for debugging.
  public var debugDescription: String {
    let texts = (0..<4).map { column in
      "[" + (0..<4).map { self[column][$0].description }.joined(separator: ", ") + "]"
    }
    return "simd_float4x4([" + texts.joined(separator: ", ") + "])"
  }
}

extension simd_float4x4 {
  /// The sum of two matrices.
  public static func + (lhs: Self, rhs: Self) -> Self {
    Self(
      lhs.columns.0 + rhs.columns.0, lhs.columns.1 + rhs.columns.1,
      lhs.columns.2 + rhs.columns.2, lhs.columns.3 + rhs.columns.3)
  }

  /// The difference of two matrices.
  public static func - (lhs: Self, rhs: Self) -> Self { lhs + -rhs }

  /// The negated matrix.
  public static prefix func - (matrix: Self) -> Self { -1 * matrix }

  /// The matrix multiplied by a scalar.
  public static func * (lhs: Float, rhs: Self) -> Self {
    Self(
      lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2, lhs * rhs.columns.3)
  }

  /// The matrix multiplied by a scalar.
  public static func * (lhs: Self, rhs: Float) -> Self { rhs * lhs }

  /// The product of a matrix and a column vector.
  public static func * (lhs: Self, rhs: simd_float4) -> simd_float4 { product(lhs.columns, rhs) }

  /// The product of a row vector and a matrix.
  public static func * (lhs: simd_float4, rhs: Self) -> simd_float4 {
    product(transposed(rhs.columns), lhs)
  }

  /// The product of two matrices.
  public static func * (lhs: Self, rhs: Self) -> Self {
    Self(
      lhs * rhs.columns.0, lhs * rhs.columns.1, lhs * rhs.columns.2, lhs * rhs.columns.3)
  }

  /// Adds a matrix.
  public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a matrix.
  public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a matrix on the right.
  public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  public static func *= (lhs: inout Self, rhs: Float) { lhs = lhs * rhs }
}

/// The short name of the type.
public typealias float4x4 = simd_float4x4
/// The name of the type in C.
public typealias matrix_float4x4 = simd_float4x4
/// The 4×4 identity matrix.
public let matrix_identity_float4x4 = simd_float4x4(1)

/// Makes a matrix from its columns.
public func simd_matrix(
  _ column0: simd_float4, _ column1: simd_float4, _ column2: simd_float4, _ column3: simd_float4
) -> simd_float4x4 {
  simd_float4x4(column0, column1, column2, column3)
}

/// The product of two matrices.
public func simd_mul(_ x: simd_float4x4, _ y: simd_float4x4) -> simd_float4x4 { x * y }

/// The product of a matrix and a column vector.
public func simd_mul(_ x: simd_float4x4, _ y: simd_float4) -> simd_float4 { x * y }

/// The inverse of a matrix.
public func simd_inverse(_ x: simd_float4x4) -> simd_float4x4 { x.inverse }

/// The transpose of a matrix.
public func simd_transpose(_ x: simd_float4x4) -> simd_float4x4 { x.transpose }

/// The determinant of a matrix.
public func simd_determinant(_ x: simd_float4x4) -> Float { x.determinant }

/// Whether corresponding elements differ by no more than `tolerance`.
public func simd_almost_equal_elements(
  _ x: simd_float4x4, _ y: simd_float4x4, _ tolerance: Float
) -> Bool {
  (0..<4).allSatisfy { norm_inf(x[$0] - y[$0]) <= tolerance }
}
