/// Value types of the crate format.
enum CrateType: UInt64 {
  case bool = 1
  case int = 3
  case float = 8
  case double = 9
  case string = 10
  case token = 11
  case asset = 12
  case float2 = 20
  case float3 = 24
  case float4 = 28
  case dictionary = 31
  case tokenListOp = 32
  case pathListOp = 34
  case tokenVector = 41
  case specifier = 42
  case variability = 44
}

/// Representation of a value in eight bytes: type, flags, and either the value or its offset.
struct CrateValueRep: Hashable {
  var bits: UInt64

  private static let array: UInt64 = 1 << 63
  private static let inlined: UInt64 = 1 << 62
  private static let compressed: UInt64 = 1 << 61

  /// A value that fits in the payload.
  static func inlined(_ type: CrateType, _ payload: UInt32) -> Self {
    Self(bits: inlined | type.rawValue << 48 | UInt64(payload))
  }

  /// A single value at `offset`.
  static func stored(_ type: CrateType, at offset: Int) -> Self {
    Self(bits: type.rawValue << 48 | UInt64(offset))
  }

  /// An array at `offset`; offset 0 means an empty one.
  static func array(_ type: CrateType, at offset: Int, isCompressed: Bool = false) -> Self {
    Self(bits: array | (isCompressed ? compressed : 0) | type.rawValue << 48 | UInt64(offset))
  }
}

/// Distinct values, numbered in order of their first appearance.
struct CrateTable<Element: Hashable> {
  private(set) var elements: [Element] = []
  private var indices: [Element: UInt32] = [:]

  mutating func index(_ element: Element) -> UInt32 {
    if let index = indices[element] { return index }
    let index = UInt32(elements.count)
    elements.append(element)
    indices[element] = index
    return index
  }
}

/// A name-value pair of a spec, by indices.
struct CrateField: Hashable {
  var token: UInt32
  var value: CrateValueRep
}

/// The kind of object at a path of the layer.
enum CrateSpecType: Int32 {
  case attribute = 1
  case prim = 6
  case pseudoRoot = 7
  case relationship = 8
}

/// The path of a prim or property, as a node of a tree that is stored depth first.
struct CratePath {
  /// The token of the last path element; the root has none.
  var token: UInt32
  var isProperty: Bool
  var children: [Int] = []
}
