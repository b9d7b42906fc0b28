/// The tables of a crate file, checked: every index in them is valid.
struct CrateTables {
  struct Spec {
    /// Index into `paths`.
    var path: Int
    /// Index into `fieldSets`.
    var fieldSet: Int
    /// Nil for a kind of object that this module doesn't know.
    var type: CrateSpecType?
  }

  let tokens: [String]
  /// Indices into `tokens`.
  let strings: [UInt32]
  let fields: [CrateField]
  /// Indices into `fields`; each set ends with `endOfSet`.
  let fieldSets: [UInt32]
  let paths: CratePathTable
  let specs: [Spec]

  static let endOfSet = UInt32.max

  /// Throws a `FormatFault`, or `ByteCursor.Truncated`.
  init(_ file: CrateFile, budget: MemoryBudget) throws {
    var tables = TableReader(budget: budget)
    tokens = try tables.tokens(try file.section("TOKENS"))
    strings = try tables.strings(try file.section("STRINGS"), tokenCount: tokens.count)
    fields = try tables.fields(try file.section("FIELDS"), tokenCount: tokens.count)
    fieldSets = try tables.fieldSets(try file.section("FIELDSETS"), fieldCount: fields.count)
    paths = try tables.paths(try file.section("PATHS"), tokenCount: tokens.count)
    specs = try tables.specs(
      try file.section("SPECS"), pathCount: paths.nodes.count, setCount: fieldSets.count)
  }

  /// The fields of a spec.
  func fields(
    of spec: Spec, budget: MemoryBudget
  ) throws -> [(name: String, value: CrateValueRep)] {
    let set = fieldSets[spec.fieldSet...].prefix { $0 != Self.endOfSet }
    try budget.spend(set.count, of: MemoryLayout<CrateField>.stride)
    return set.map {
      let field = fields[Int($0)]
      return (tokens[Int(field.token)], field.value)
    }
  }
}

/// Reads one table after the other.
private struct TableReader {
  let budget: MemoryBudget

  /// A count, compressed integers of the count, and the size that precedes them.
  private func integers(_ cursor: inout ByteCursor, count: Int) throws -> [Int32] {
    try budget.spend(count, of: 4)
    let size = try cursor.count()
    return try CrateCompression.decompress(try cursor.take(size), count: count, as: Int32.self)
  }

  /// The integers as indices below `count`, except `exception`.
  private func indices(
    _ integers: [Int32], below count: Int, except exception: UInt32? = nil
  ) throws -> [UInt32] {
    let indices = integers.map { UInt32(bitPattern: $0) }
    guard indices.allSatisfy({ $0 < count || $0 == exception }) else {
      throw FormatFault("an index in its tables is out of range")
    }
    return indices
  }

  mutating func tokens(_ section: ByteCursor) throws -> [String] {
    var cursor = section
    let count = try cursor.count()
    let size = try cursor.count()
    try budget.spend(size)
    try budget.spend(count, of: MemoryLayout<String>.stride)
    let compressed = try cursor.take(try cursor.count())
    let text = try CrateCompression.decompress(compressed, maximumCount: size)
    let tokens = text.split(separator: 0, maxSplits: count, omittingEmptySubsequences: false)
    guard tokens.count > count else { throw FormatFault("it has fewer tokens than it declares") }
    return tokens.prefix(count).map { String(decoding: $0, as: UTF8.self) }
  }

  mutating func strings(_ section: ByteCursor, tokenCount: Int) throws -> [UInt32] {
    var cursor = section
    let strings = try cursor.values(Int32.self, count: try cursor.count())
    return try indices(strings, below: tokenCount)
  }

  mutating func fields(_ section: ByteCursor, tokenCount: Int) throws -> [CrateField] {
    var cursor = section
    let count = try cursor.count()
    let tokens = try indices(try integers(&cursor, count: count), below: tokenCount)
    try budget.spend(count, of: 16)
    let compressed = try cursor.take(try cursor.count())
    var values = ByteCursor(
      try CrateCompression.decompress(compressed, maximumCount: 8 * count))
    return zip(tokens, try values.values(UInt64.self, count: count)).map {
      CrateField(token: $0, value: CrateValueRep(bits: $1))
    }
  }

  mutating func fieldSets(_ section: ByteCursor, fieldCount: Int) throws -> [UInt32] {
    var cursor = section
    let count = try cursor.count()
    return try indices(
      try integers(&cursor, count: count), below: fieldCount, except: CrateTables.endOfSet)
  }

  mutating func paths(_ section: ByteCursor, tokenCount: Int) throws -> CratePathTable {
    var cursor = section
    let count = try cursor.count()
    try budget.spend(count, of: MemoryLayout<CratePathTable.Node>.stride)
    let encoded = try cursor.count()
    let paths = try indices(try integers(&cursor, count: encoded), below: count)
    let tokens = try integers(&cursor, count: encoded)
    let jumps = try integers(&cursor, count: encoded)
    guard tokens.allSatisfy({ $0.magnitude < max(tokenCount, 1) }) else {
      throw FormatFault("a path refers to a token that does not exist")
    }
    return try CratePathTable(count: count, paths: paths, tokens: tokens, jumps: jumps)
  }

  mutating func specs(
    _ section: ByteCursor, pathCount: Int, setCount: Int
  ) throws -> [CrateTables.Spec] {
    var cursor = section
    let count = try cursor.count()
    let paths = try indices(try integers(&cursor, count: count), below: pathCount)
    let sets = try indices(try integers(&cursor, count: count), below: setCount)
    let types = try integers(&cursor, count: count)
    try budget.spend(count, of: MemoryLayout<CrateTables.Spec>.stride)
    return (0..<count).map {
      CrateTables.Spec(
        path: Int(paths[$0]), fieldSet: Int(sets[$0]), type: CrateSpecType(rawValue: types[$0]))
    }
  }
}
