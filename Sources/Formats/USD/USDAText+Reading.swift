extension USDAText {
  /// The layer of a text: what `USDValue` can represent; of animated values, the first sample.
  /// Variants are ignored. Throws a `FormatFault`.
  static func decode(_ bytes: [UInt8]) throws -> USDLayer {
    guard bytes.starts(with: Array("#usda".utf8)) else {
      throw FormatFault("it does not begin with #usda")
    }
    var parser = try USDAParser(bytes)
    return try parser.layer()
  }
}

/// A recursive descent parser of layers.
private struct USDAParser {
  /// Nesting of values and prims. Chosen: as in `USDStage`.
  private static let maximumDepth = 128

  private var tokenizer: USDATokenizer
  private var token: USDATokenizer.Token

  init(_ bytes: [UInt8]) throws {
    tokenizer = USDATokenizer(bytes)
    token = try tokenizer.next()
  }

  // MARK: Tokens

  private mutating func advance() throws { token = try tokenizer.next() }

  private func unexpected() -> FormatFault {
    FormatFault("its text is not valid USD in line \(tokenizer.line)")
  }

  /// Skips a symbol if it is next.
  private mutating func skip(_ symbol: Unicode.Scalar) throws -> Bool {
    guard token == .symbol(UInt8(ascii: symbol)) else { return false }
    try advance()
    return true
  }

  private mutating func expect(_ symbol: Unicode.Scalar) throws {
    guard try skip(symbol) else { throw unexpected() }
  }

  private mutating func word() throws -> String {
    guard case .word(let word) = token else { throw unexpected() }
    try advance()
    return word
  }

  private mutating func string() throws -> String {
    guard case .string(let text) = token else { throw unexpected() }
    try advance()
    return text
  }

  // MARK: Prims

  mutating func layer() throws -> USDLayer {
    var layer = USDLayer(metadata: [], defaultPrim: "", prims: [])
    for field in try metadata() {
      if field.name == "defaultPrim", case .string(let name) = field.value {
        layer.defaultPrim = name
      } else {
        layer.metadata.append(field)
      }
    }
    while token != .end {
      let keyword = try word()
      if let prim = try prim(keyword, depth: 0) {
        layer.prims.append(prim)
      } else if keyword == "reorder" {
        _ = try word()
        try expect("=")
        _ = try values()
      } else {
        throw unexpected()
      }
    }
    return layer
  }

  /// A prim after its specifier; nil if `keyword` is none.
  private mutating func prim(_ keyword: String, depth: Int) throws -> USDPrim? {
    guard let specifier = USDPrim.Specifier(rawValue: keyword) else { return nil }
    guard depth < Self.maximumDepth else { throw FormatFault("its prims are nested too deeply") }
    var type = ""
    if case .word = token { type = try word() }
    var prim = USDPrim(type, try string())
    prim.specifier = specifier
    for field in try metadata() {
      if field.name == "apiSchemas", case .tokenArray(let names) = field.value {
        prim.apiSchemas = names
      } else {
        prim.metadata.append(field)
      }
    }
    try expect("{")
    while try !skip("}") { try item(of: &prim, depth: depth) }
    return prim
  }

  /// A property, a nested prim, or something else in the body of a prim.
  private mutating func item(of prim: inout USDPrim, depth: Int) throws {
    if try skip(";") { return }
    let keyword = try word()
    if let child = try self.prim(keyword, depth: depth + 1) {
      prim.children.append(child)
    } else if keyword == "variantSet" {
      _ = try string()
      try expect("=")
      try skipBraces()
    } else if keyword == "reorder" {
      _ = try word()
      try expect("=")
      _ = try values()
    } else {
      try property(startingWith: keyword, of: &prim)
    }
  }

  // MARK: Properties

  private mutating func property(startingWith first: String, of prim: inout USDPrim) throws {
    var (word, isUniform) = (first, false)
    var isDeletion = false
    while [
      "custom", "uniform", "varying", "config", "prepend", "append", "add", "delete",
      "reorder",
    ].contains(word) {
      isUniform = isUniform || word == "uniform"
      isDeletion = isDeletion || word == "delete" || word == "reorder"
      word = try self.word()
    }
    let type = word
    var name = try self.word()
    var values = USDAValues()
    var isAssigned = false
    let suffix = ["connect", "timeSamples"].first { name.hasSuffix("." + $0) }
    name.removeLast(suffix.map { $0.utf8.count + 1 } ?? 0)
    if try skip("=") {
      isAssigned = true
      values = suffix == "timeSamples" ? try firstSample() : try self.values()
    }
    let metadata = try self.metadata()
    guard !isDeletion else { return }
    var property = USDProperty.relationship(name, values.paths)
    property.isUniform = isUniform || type == "rel"
    property.metadata = metadata
    if type != "rel" {
      property.content = .attribute(
        typeName: type, value: isAssigned && suffix != "connect" ? values.value(of: type) : nil,
        connections: suffix == "connect" ? values.paths : [])
    }
    append(property, to: &prim)
  }

  /// Adds a property, or what a second statement adds to a property: value or connection.
  private func append(_ property: USDProperty, to prim: inout USDPrim) {
    guard let index = prim.properties.indices.last, prim.properties[index].name == property.name,
      case .attribute(let type, let oldValue, let oldConnections) = prim.properties[index].content,
      case .attribute(_, let value, let connections) = property.content
    else {
      prim.properties.append(property)
      return
    }
    // A value is stronger than the first sample of an animation.
    prim.properties[index].content = .attribute(
      typeName: type, value: oldValue ?? value, connections: oldConnections + connections)
    prim.properties[index].metadata += property.metadata
  }

  /// The first of a list of times and values between braces.
  private mutating func firstSample() throws -> USDAValues {
    try expect("{")
    var first: USDAValues?
    while try !skip("}") {
      guard case .number = token else { throw unexpected() }
      try advance()
      try expect(":")
      let values = try self.values()
      if first == nil { first = values }
      _ = try skip(",")
    }
    return first ?? USDAValues()
  }

  // MARK: Metadata

  /// What is between parentheses; empty without them.
  private mutating func metadata() throws -> [USDField] {
    guard try skip("(") else { return [] }
    var fields: [USDField] = []
    while try !skip(")") {
      if try skip(";") || skip(",") { continue }
      if case .string = token {
        // Documentation.
        try advance()
        continue
      }
      var name = try word()
      var isDeletion = false
      if ["prepend", "append", "add", "delete", "reorder"].contains(name) {
        isDeletion = name == "delete" || name == "reorder"
        name = try word()
      }
      try expect("=")
      let values = try self.values()
      if !isDeletion, let value = values.metadataValue(of: name) {
        fields.append(USDField(name, value))
      }
    }
    return fields
  }

  // MARK: Values

  /// All numbers, strings, paths … of a value, without its brackets.
  private mutating func values() throws -> USDAValues {
    var values = USDAValues()
    var open: [UInt8] = []
    repeat {
      switch token {
      case .number(let number): values.numbers.append(number)
      case .string(let text): values.strings.append(text)
      case .word(let word):
        values.append(word: word)
        if word == "None", open.isEmpty { values.isNone = true }
      case .asset(let asset): values.references.append(USDReference(asset: asset, path: ""))
      case .path(let path): values.append(path: path)
      case .symbol(UInt8(ascii: "[")), .symbol(UInt8(ascii: "(")):
        if case .symbol(let symbol) = token { open.append(symbol) }
        if open.count == 1, open[0] == UInt8(ascii: "[") { values.isList = true }
        guard open.count < Self.maximumDepth else { throw unexpected() }
      case .symbol(UInt8(ascii: "]")):
        guard open.popLast() == UInt8(ascii: "[") else { throw unexpected() }
      case .symbol(UInt8(ascii: ")")):
        guard open.popLast() == UInt8(ascii: "(") else { throw unexpected() }
      case .symbol(UInt8(ascii: "{")):
        try skipBraces()
        continue
      case .symbol(UInt8(ascii: ",")) where !open.isEmpty,
        .symbol(UInt8(ascii: "=")) where !open.isEmpty,
        .symbol(UInt8(ascii: ";")) where !open.isEmpty:
        break
      default: throw unexpected()
      }
      try advance()
    } while try !open.isEmpty || continuesReference(values)
    return values
  }

  /// Whether the path of the prim, or an offset in time, follows the layer of a reference.
  private func continuesReference(_ values: USDAValues) throws -> Bool {
    guard !values.references.isEmpty, !values.isList else { return false }
    if case .path = token { return true }
    return false
  }

  /// Skips a block between braces with everything in it.
  private mutating func skipBraces() throws {
    try expect("{")
    var depth = 1
    while depth > 0 {
      switch token {
      case .symbol(UInt8(ascii: "{")): depth += 1
      case .symbol(UInt8(ascii: "}")): depth -= 1
      case .end: throw unexpected()
      default: break
      }
      try advance()
    }
  }
}
