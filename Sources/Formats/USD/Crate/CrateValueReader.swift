import SceneModel

/// Decodes values of an untrusted crate file. Those of a type that this module doesn't use are nil.
struct CrateValueReader {
  /// Shorter arrays are stored uncompressed. Limit: `MinCompressedArraySize` of OpenUSD.
  private static let minimumCompressedCount = 16
  /// A time sample could be another list of samples. Chosen: one level has a meaning.
  private static let maximumNesting = 4

  let file: CrateFile
  let tables: CrateTables
  let budget: MemoryBudget

  /// Throws a `FormatFault`, or `ByteCursor.Truncated`.
  func value(_ rep: CrateValueRep, nesting: Int = 0) throws -> USDValue? {
    guard let type = rep.type, nesting < Self.maximumNesting else { return nil }
    if rep.isArray { return try array(type, rep) }
    if rep.isInlined { return try inlined(type, UInt32(truncatingIfNeeded: rep.payload)) }
    switch type {
    case .double: return .double(try numbers(rep, 1, .double)[0])
    case .int64, .uint64: return .double(Double(Int64(bitPattern: try integer(rep))))
    case .float2, .half2, .double2, .float3, .half3, .float4, .half4, .double4, .quath, .quatf,
      .quatd:
      return Self.vector(try numbers(rep, type.width, type.element).map { Float($0) })
    case .double3:
      let v = try numbers(rep, 3, .double)
      return .double3([v[0], v[1], v[2]])
    case .matrix4d: return .matrix4(try numbers(rep, 16, .double))
    case .timeSamples: return try firstSample(rep, nesting)
    case .tokenVector: return .tokenArray(try indices(rep).map { try token($0) })
    case .stringVector: return .tokenArray(try indices(rep).map { try string($0) })
    case .tokenListOp: return .tokenArray(try items(rep) { try token($0) })
    case .referenceListOp, .payloadListOp, .payload: return .references(try references(rep))
    default: return nil
    }
  }

  /// The paths of a list edit, or of a list.
  func paths(_ rep: CrateValueRep) throws -> [String] {
    func path(_ index: UInt32) throws -> String {
      try tables.paths.text(of: Int(index), tokens: tables.tokens, budget: budget)
    }
    switch rep.type {
    case .pathListOp: return try items(rep, path)
    case .pathVector: return try indices(rep).map(path)
    default: return []
    }
  }

  private func cursor(_ rep: CrateValueRep) throws -> ByteCursor {
    var cursor = ByteCursor(file.bytes)
    try cursor.seek(to: Int(rep.payload))
    return cursor
  }

  private func integer(_ rep: CrateValueRep) throws -> UInt64 {
    var cursor = try cursor(rep)
    return try cursor.unsigned(8)
  }

  func token(_ index: UInt32) throws -> String {
    guard tables.tokens.indices.contains(Int(index)) else {
      throw FormatFault("a value refers to a token that does not exist")
    }
    return tables.tokens[Int(index)]
  }

  private func string(_ index: UInt32) throws -> String {
    guard tables.strings.indices.contains(Int(index)) else {
      throw FormatFault("a value refers to a string that does not exist")
    }
    return try token(tables.strings[Int(index)])
  }
}

// MARK: - Single values

extension CrateValueReader {
  private func inlined(_ type: CrateType, _ payload: UInt32) throws -> USDValue? {
    let bytes = (0..<4).map { Int8(truncatingIfNeeded: payload >> (8 * UInt32($0))) }
    switch type {
    case .bool: return .bool(payload != 0)
    case .uchar: return .int(Int32(payload & 0xFF))
    case .int, .uint, .specifier, .variability: return .int(Int32(bitPattern: payload))
    case .int64, .uint64: return .double(Double(Int32(bitPattern: payload)))
    case .half: return .float(HalfFloat(bitPattern: UInt16(truncatingIfNeeded: payload)).float)
    case .half2:
      // Four bytes are stored as they are; longer vectors as a byte per component.
      return .float2([
        HalfFloat(bitPattern: UInt16(truncatingIfNeeded: payload)).float,
        HalfFloat(bitPattern: UInt16(truncatingIfNeeded: payload >> 16)).float,
      ])
    case .float: return .float(Float(bitPattern: payload))
    case .double: return .double(Double(Float(bitPattern: payload)))
    case .token: return .token(try token(payload))
    case .string: return .string(try string(payload))
    case .asset: return .asset(try token(payload))
    case .double3: return .double3(SIMD3(Double(bytes[0]), Double(bytes[1]), Double(bytes[2])))
    case .matrix4d:
      return .matrix4((0..<16).map { $0 % 5 == 0 ? Double(bytes[$0 / 5]) : 0 })
    default:
      return type.width > 1 ? Self.vector(bytes.prefix(type.width).map { Float($0) }) : nil
    }
  }

  private static func vector(_ v: [Float]) -> USDValue? {
    switch v.count {
    case 2: .float2([v[0], v[1]])
    case 3: .float3([v[0], v[1], v[2]])
    case 4: .float4([v[0], v[1], v[2], v[3]])
    default: nil
    }
  }

  private func numbers(
    _ rep: CrateValueRep, _ count: Int, _ element: CrateType
  ) throws -> [Double] {
    var cursor = try cursor(rep)
    switch element {
    case .half: return try cursor.values(HalfFloat.self, count: count).map { Double($0.float) }
    case .float: return try cursor.values(Float.self, count: count).map { Double($0) }
    default: return try cursor.values(Double.self, count: count)
    }
  }

  /// The value at the first time; each part is preceded by the distance to its end.
  private func firstSample(_ rep: CrateValueRep, _ nesting: Int) throws -> USDValue? {
    var cursor = try cursor(rep)
    for _ in 0..<2 {
      let start = cursor.offset
      let (position, overflow) = start.addingReportingOverflow(try cursor.count())
      guard !overflow else { throw ByteCursor.Truncated() }
      try cursor.seek(to: position)
      // The first part is the list of times.
      if start == Int(rep.payload) { _ = try cursor.unsigned(8) }
    }
    guard try cursor.count() > 0 else { return nil }
    return try value(CrateValueRep(bits: try cursor.unsigned(8)), nesting: nesting + 1)
  }
}

// MARK: - Lists

extension CrateValueReader {
  private func indices(_ rep: CrateValueRep) throws -> [UInt32] {
    var cursor = try cursor(rep)
    let count = try cursor.count()
    try budget.spend(count, of: MemoryLayout<String>.stride)
    return try cursor.values(UInt32.self, count: count)
  }

  /// The items that a list edit sets or adds.
  private func items<Item>(
    _ rep: CrateValueRep, _ item: (UInt32) throws -> Item
  ) throws -> [Item] {
    guard !rep.isInlined else { return [] }
    var cursor = try cursor(rep)
    let header = UInt8(try cursor.unsigned(1))
    var result: [Item] = []
    for bit in CrateListOpBits.items where header & bit != 0 {
      let count = try cursor.count()
      try budget.spend(count, of: MemoryLayout<String>.stride)
      let indices = try cursor.values(UInt32.self, count: count)
      if bit & CrateListOpBits.present != 0 { result += try indices.map(item) }
    }
    return result
  }

  /// The references or payloads that a list edit sets or adds; a single payload has no list.
  private func references(_ rep: CrateValueRep) throws -> [USDReference] {
    guard !rep.isInlined else { return [] }
    var cursor = try cursor(rep)
    if rep.type == .payload { return [try reference(&cursor)] }
    let header = UInt8(try cursor.unsigned(1))
    var result: [USDReference] = []
    for bit in CrateListOpBits.items where header & bit != 0 {
      for _ in 0..<(try cursor.count()) {
        let item = try reference(&cursor)
        if rep.type == .referenceListOp || file.version >= 8 { _ = try cursor.take(16) }
        if rep.type == .referenceListOp, try cursor.count() > 0 {
          throw UnsupportedFeature(
            reason: "a reference has custom data", remedy: "Flatten it with usdcat of OpenUSD.")
        }
        if bit & CrateListOpBits.present != 0 { result.append(item) }
      }
    }
    return result
  }

  private func reference(_ cursor: inout ByteCursor) throws -> USDReference {
    try budget.spend(MemoryLayout<USDReference>.stride)
    let asset = try string(UInt32(try cursor.unsigned(4)))
    let path = Int(try cursor.unsigned(4))
    return USDReference(
      asset: asset,
      // The empty path has an index of its own, or that of the root.
      path: tables.paths.nodes.indices.contains(path) && tables.paths.nodes[path].parent != nil
        ? try tables.paths.text(of: path, tokens: tables.tokens, budget: budget) : "")
  }
}

// MARK: - Arrays

extension CrateValueReader {
  private func array(_ type: CrateType, _ rep: CrateValueRep) throws -> USDValue? {
    // An empty array has no content.
    guard rep.payload > 0 else { return try array(type, ArrayContent(cursor: ByteCursor([]))) }
    var cursor = try cursor(rep)
    // Until version 0.5, the number of dimensions.
    if file.version < 5 { _ = try cursor.unsigned(4) }
    let count = file.version < 7 ? Int(try cursor.unsigned(4)) : try cursor.count()
    let isCompressed = rep.isCompressed && count >= Self.minimumCompressedCount
    return try array(
      type, ArrayContent(cursor: cursor, count: count, isCompressed: isCompressed, budget: budget))
  }

  private func array(_ type: CrateType, _ content: ArrayContent) throws -> USDValue? {
    switch type {
    case .int, .uint: return .intArray(try content.integers(Int32.self))
    case .int64, .uint64:
      return .intArray(try content.integers(Int64.self).map { Int32(clamping: $0) })
    case .half, .float, .double: return .floatArray(try content.floats(type))
    case .half2, .float2, .double2:
      let v = try content.components(type)
      return .float2Array(stride(from: 0, to: v.count, by: 2).map { SIMD2(v[$0], v[$0 + 1]) })
    case .half3, .float3, .double3:
      let v = try content.components(type)
      return .float3Array(
        stride(from: 0, to: v.count, by: 3).map { SIMD3(v[$0], v[$0 + 1], v[$0 + 2]) })
    case .half4, .float4, .double4:
      let v = try content.components(type)
      return .float4Array(
        stride(from: 0, to: v.count, by: 4).map { SIMD4(v[$0], v[$0 + 1], v[$0 + 2], v[$0 + 3]) })
    case .token: return .tokenArray(try content.indices().map { try token($0) })
    case .string: return .tokenArray(try content.indices().map { try string($0) })
    default: return nil
    }
  }
}

extension CrateType {
  /// The number of components of a vector or quaternion; 1 for other types.
  var width: Int {
    switch self {
    case .half2, .float2, .double2: 2
    case .half3, .float3, .double3: 3
    case .half4, .float4, .double4, .quath, .quatf, .quatd: 4
    default: 1
    }
  }

  /// The type of the components of a vector or quaternion; other types have themselves.
  var element: CrateType {
    switch self {
    case .half2, .half3, .half4, .quath: .half
    case .float2, .float3, .float4, .quatf: .float
    case .double2, .double3, .double4, .quatd: .double
    default: self
    }
  }
}

/// The content of an array after its count.
private struct ArrayContent {
  var cursor: ByteCursor
  var count = 0
  var isCompressed = false
  var budget = MemoryBudget(forFileOf: 0)

  func integers<Number: FixedWidthInteger & SignedInteger & BitwiseCopyable>(
    _ type: Number.Type
  ) throws -> [Number] {
    try budget.spend(count, of: MemoryLayout<Number>.stride)
    var cursor = cursor
    return isCompressed
      ? try Self.compressedIntegers(&cursor, count) : try cursor.values(type, count: count)
  }

  func indices() throws -> [UInt32] {
    try budget.spend(count, of: MemoryLayout<String>.stride)
    var cursor = cursor
    return try cursor.values(UInt32.self, count: count)
  }

  /// Single numbers; if compressed, as integers or as indices into a table.
  func floats(_ type: CrateType) throws -> [Float] {
    guard isCompressed else { return try components(type) }
    try budget.spend(count, of: 8)
    var cursor = cursor
    switch UInt8(try cursor.unsigned(1)) {
    case UInt8(ascii: "i"):
      let integers: [Int32] = try Self.compressedIntegers(&cursor, count)
      return integers.map { Float($0) }
    case UInt8(ascii: "t"):
      let size = Int(try cursor.unsigned(4))
      let table = try Self.numbers(&cursor, type, size)
      let indices: [Int32] = try Self.compressedIntegers(&cursor, count)
      guard indices.allSatisfy({ table.indices.contains(Int($0)) }) else {
        throw FormatFault("an index into a table of numbers is out of range")
      }
      return indices.map { table[Int($0)] }
    default: throw FormatFault("an array of numbers has an unknown compression")
    }
  }

  /// The components of vectors, uncompressed.
  func components(_ type: CrateType) throws -> [Float] {
    try budget.spend(count, of: 4 * type.width)
    var cursor = cursor
    let (total, overflow) = count.multipliedReportingOverflow(by: type.width)
    guard !overflow else { throw ByteCursor.Truncated() }
    return try Self.numbers(&cursor, type.element, total)
  }

  private static func numbers(
    _ cursor: inout ByteCursor, _ type: CrateType, _ count: Int
  ) throws -> [Float] {
    switch type {
    case .half: try cursor.values(HalfFloat.self, count: count).map(\.float)
    case .float: try cursor.values(Float.self, count: count)
    default: try cursor.values(Double.self, count: count).map { Float($0) }
    }
  }

  private static func compressedIntegers<Number: FixedWidthInteger & SignedInteger>(
    _ cursor: inout ByteCursor, _ count: Int
  ) throws -> [Number] {
    let size = try cursor.count()
    return try CrateCompression.decompress(try cursor.take(size), count: count, as: Number.self)
  }
}
