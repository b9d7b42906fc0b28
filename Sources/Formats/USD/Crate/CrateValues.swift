import SceneModel

/// The value section of a crate file, and the tables that it refers to.
struct CrateValues {
  /// The bytes of the file from its start.
  var file: ByteWriter
  /// Token 0 is reserved, so that no property has it: its index couldn't be negated.
  var tokens = CrateTable<String>()
  /// Token indices of the strings.
  var strings = CrateTable<UInt32>()
  var paths = CratePaths()

  private typealias ListOpBits = CrateListOpBits

  /// Shorter integer arrays are stored uncompressed. Limit: of the format.
  private static let minimumCompressedCount = 16

  init(file: ByteWriter) {
    self.file = file
    _ = tokens.index("")
  }

  /// The index of a string in `strings`.
  mutating func string(_ text: String) -> UInt32 { strings.index(tokens.index(text)) }

  /// Stores a value and returns its representation.
  mutating func store(_ value: USDValue) -> CrateValueRep {
    switch value {
    case .bool(let value): return .inlined(.bool, value ? 1 : 0)
    case .int(let value): return .inlined(.int, UInt32(bitPattern: value))
    case .float(let value): return .inlined(.float, value.bitPattern)
    case .double(let value): return store(value)
    case .token(let name): return .inlined(.token, tokens.index(name))
    case .string(let text): return .inlined(.string, string(text))
    case .asset(let path): return .inlined(.asset, tokens.index(path))
    case .float2(let v): return storeVector(.float2, [v.x, v.y])
    case .float3(let v): return storeVector(.float3, [v.x, v.y, v.z])
    case .float4(let v): return storeVector(.float4, [v.x, v.y, v.z, v.w])
    case .double3(let v): return storeNumbers(.double3, [v.x, v.y, v.z])
    case .matrix4(let elements): return storeNumbers(.matrix4d, elements)
    case .tokenArray(let names):
      let indices = names.map { tokens.index($0) }
      return storeArray(.token, indices) { $1.append($0) }
    case .intArray(let values): return storeIntegers(values)
    case .floatArray(let values): return storeArray(.float, values) { $1.append($0) }
    case .float2Array(let values): return storeArray(.float2, values) { $1.append($0) }
    case .float3Array(let values): return storeArray(.float3, values) { $1.append($0) }
    case .float4Array(let values):
      return storeArray(.float4, values) {
        $1.append($0.lowHalf)
        $1.append($0.highHalf)
      }
    case .dictionary(let entries): return storeDictionary(entries)
    case .references(let references): return store(references)
    }
  }

  private mutating func storeNumbers(_ type: CrateType, _ values: [Double]) -> CrateValueRep {
    file.align(to: 8)
    defer { for value in values { file.append(value) } }
    return .stored(type, at: file.count)
  }

  /// An explicit list; each reference is a layer, a path, an offset and a scale of time, and an
  /// empty dictionary.
  private mutating func store(_ references: [USDReference]) -> CrateValueRep {
    let indices = references.map {
      (asset: string($0.asset), path: $0.path.isEmpty ? 0 : UInt32(paths.index($0.path, &tokens)))
    }
    file.align(to: 8)
    let offset = file.count
    file.append(ListOpBits.isExplicit | ListOpBits.hasExplicitItems)
    file.append(UInt64(references.count))
    for reference in indices {
      file.append(reference.asset)
      file.append(reference.path)
      file.append(0.0)
      file.append(1.0)
      file.append(UInt64(0))
    }
    return .stored(.referenceListOp, at: offset)
  }

  private mutating func store(_ value: Double) -> CrateValueRep {
    let short = Float(value)
    if Double(short) == value { return .inlined(.double, short.bitPattern) }
    file.align(to: 8)
    defer { file.append(value) }
    return .stored(.double, at: file.count)
  }

  /// A vector of small integers is inlined in the payload, one byte per component.
  private mutating func storeVector(_ type: CrateType, _ values: [Float]) -> CrateValueRep {
    let bytes = values.compactMap { Int8(exactly: $0) }
    if bytes.count == values.count {
      let payload = bytes.reversed().reduce(UInt32(0)) { $0 << 8 | UInt32(UInt8(bitPattern: $1)) }
      return .inlined(type, payload)
    }
    file.align(to: 8)
    defer { for value in values { file.append(value) } }
    return .stored(type, at: file.count)
  }

  private mutating func storeArray<T>(
    _ type: CrateType, _ values: [T], _ append: (T, inout ByteWriter) -> Void
  ) -> CrateValueRep {
    guard !values.isEmpty else { return .array(type, at: 0) }
    file.align(to: 8)
    let offset = file.count
    file.append(UInt64(values.count))
    for value in values { append(value, &file) }
    return .array(type, at: offset)
  }

  private mutating func storeIntegers(_ values: [Int32]) -> CrateValueRep {
    guard values.count >= Self.minimumCompressedCount else {
      return storeArray(.int, values) { $1.append($0) }
    }
    file.align(to: 8)
    let offset = file.count
    let compressed = CrateCompression.compress(values)
    file.append(UInt64(values.count))
    file.append(UInt64(compressed.count))
    file.append(contentsOf: compressed)
    return .array(.int, at: offset, isCompressed: true)
  }

  /// Each entry is its key, the distance to its representation, nested values, and the
  /// representation.
  private mutating func storeDictionary(_ entries: [USDField]) -> CrateValueRep {
    file.align(to: 8)
    let offset = file.count
    file.append(UInt64(entries.count))
    for entry in entries {
      file.append(string(entry.name))
      let start = file.count
      file.append(Int64(0))
      let value = store(entry.value)
      file.replace(at: start, with: Int64(file.count - start))
      file.append(value.bits)
    }
    return .stored(.dictionary, at: offset)
  }

  /// Names as a token vector, for the order of children and properties.
  mutating func storeNames(_ names: [String]) -> CrateValueRep {
    let indices = names.map { tokens.index($0) }
    file.align(to: 8)
    let offset = file.count
    file.append(UInt64(indices.count))
    for index in indices { file.append(index) }
    return .stored(.tokenVector, at: offset)
  }

  /// A list edit that prepends tokens.
  mutating func storePrepended(_ names: [String]) -> CrateValueRep {
    storeListOp(.tokenListOp, header: ListOpBits.hasPrependedItems, names.map { tokens.index($0) })
  }

  /// A list edit that replaces the list by these paths.
  mutating func storeExplicit(paths: [String]) -> CrateValueRep {
    let indices = paths.map { UInt32(self.paths.index($0, &tokens)) }
    return storeListOp(
      .pathListOp, header: ListOpBits.isExplicit | ListOpBits.hasExplicitItems, indices)
  }

  private mutating func storeListOp(
    _ type: CrateType, header: UInt8, _ indices: [UInt32]
  ) -> CrateValueRep {
    file.align(to: 8)
    let offset = file.count
    file.append(header)
    file.append(UInt64(indices.count))
    for index in indices { file.append(index) }
    return .stored(type, at: offset)
  }
}
