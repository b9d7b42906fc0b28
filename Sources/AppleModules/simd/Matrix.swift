/// The operations of square matrices of all sizes and precisions.
///
/// Not part of Apple's module: the protocol lets matrices of `Float` and `Double` share one
/// implementation. They are distinct structures and not specializations of one generic structure,
/// so that programs can conform each of them to a protocol, as on macOS.
public protocol SIMDMatrix: Hashable, Sendable, CustomDebugStringConvertible {
  /// The type of the elements.
  associatedtype Scalar: SIMDFloatingPoint
  /// A column vector with as many components as the matrix has columns.
  associatedtype Column: SIMD<Scalar>

  /// Creates a matrix from an array of its columns.
  init(_ columns: [Column])
  /// Creates a matrix with the vector on the main diagonal and zeros elsewhere.
  init(diagonal: Column)

  /// The column with the given index.
  subscript(column: Int) -> Column { get set }

  /// The matrix with columns and rows exchanged.
  var transpose: Self { get }
  /// The inverse; not finite if the matrix is singular.
  var inverse: Self { get }
  /// The determinant.
  var determinant: Scalar { get }

  /// The sum of two matrices.
  static func + (lhs: Self, rhs: Self) -> Self
  /// The matrix multiplied by a scalar.
  static func * (lhs: Scalar, rhs: Self) -> Self
  /// The product of a matrix and a column vector.
  static func * (lhs: Self, rhs: Column) -> Column
  /// The product of two matrices.
  static func * (lhs: Self, rhs: Self) -> Self
}

extension SIMDMatrix {
  /// Creates a matrix of zeros.
  @inlinable public init() { self.init(diagonal: Column(repeating: 0)) }

  /// Creates a matrix from an array of its rows.
  @inlinable public init(rows: [Column]) { self = Self(rows).transpose }

  /// Creates a matrix with the scalar on the main diagonal and zeros elsewhere.
  @inlinable public init(_ scalar: Scalar) { self.init(diagonal: Column(repeating: scalar)) }

  /// The element in the given column and row.
  @inlinable public subscript(column: Int, row: Int) -> Scalar {
    get { self[column][row] }
    set { self[column][row] = newValue }
  }

  /// The name of the type and the columns, for debugging.
  public var debugDescription: String {
    let indices = 0..<Column.scalarCount
    let texts = indices.map { column in
      "[" + indices.map { "\(self[column][$0])" }.joined(separator: ", ") + "]"
    }
    return "\(Self.self)([" + texts.joined(separator: ", ") + "])"
  }

  /// The difference of two matrices.
  @inlinable public static func - (lhs: Self, rhs: Self) -> Self { lhs + -rhs }

  /// The negated matrix.
  @inlinable public static prefix func - (matrix: Self) -> Self { -1 * matrix }

  /// The matrix multiplied by a scalar.
  @inlinable public static func * (lhs: Self, rhs: Scalar) -> Self { rhs * lhs }

  /// The product of a row vector and a matrix.
  @inlinable public static func * (lhs: Column, rhs: Self) -> Column { rhs.transpose * lhs }

  /// Adds a matrix.
  @inlinable public static func += (lhs: inout Self, rhs: Self) { lhs = lhs + rhs }

  /// Subtracts a matrix.
  @inlinable public static func -= (lhs: inout Self, rhs: Self) { lhs = lhs - rhs }

  /// Multiplies by a matrix on the right.
  @inlinable public static func *= (lhs: inout Self, rhs: Self) { lhs = lhs * rhs }

  /// Multiplies by a scalar.
  @inlinable public static func *= (lhs: inout Self, rhs: Scalar) { lhs = lhs * rhs }
}
