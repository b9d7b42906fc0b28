/// Representation of a value in eight bytes: type, flags, and either the value or its offset.
struct CrateValueRep: Hashable {
  var bits: UInt64

  private static let array: UInt64 = 1 << 63
  private static let inlined: UInt64 = 1 << 62
  private static let compressed: UInt64 = 1 << 61

  var isArray: Bool { bits & Self.array != 0 }
  var isInlined: Bool { bits & Self.inlined != 0 }
  var isCompressed: Bool { bits & Self.compressed != 0 }
  /// Nil for a type that this module doesn't know.
  var type: CrateType? { CrateType(rawValue: bits >> 48 & 0xFF) }
  /// The offset of the value, or the value itself in the lower half.
  var payload: UInt64 { bits & 0xFFFF_FFFF_FFFF }

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
