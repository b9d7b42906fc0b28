/// Writes a layer in USD's binary format, crate (.usdc).
///
/// A crate consists of a header, the values, sections with tables of tokens, strings, fields, paths
/// and specs, and a table of contents. Reference: USDC File Format Specification, Pixar.
package enum USDCrate {
  /// The bytes of `layer`.
  package static func encode(_ layer: USDLayer) -> [UInt8] {
    var writer = CrateWriter()
    writer.add(layer)
    return writer.finish()
  }
}

/// Collects the specs of a layer and writes the sections of the file.
private struct CrateWriter {
  private struct Spec {
    var path: Int
    var fieldSet: Int
    var type: CrateSpecType
  }

  /// 0.8.0, which OpenUSD 20.11 to 26.11 writes by default. Older versions are deprecated there;
  /// those after 0.9.0 are newer than macOS 12, which has to read the files. What is written does
  /// not depend on it: 0.8.0 adds payloads with offsets, 0.9.0 time codes, and layers have neither.
  private static let version: [UInt8] = [0, 8, 0, 0, 0, 0, 0, 0]
  /// Bytes of the header. Limit: of the format.
  private static let headerSize = 88
  /// Offset in the header of the position of the table of contents. Limit: of the format.
  private static let contentsOffset = 16
  /// Bytes of a section's name in the table of contents. Limit: of the format.
  private static let sectionNameSize = 16
  private static let endOfSet: UInt32 = .max

  private var values: CrateValues
  private var fields = CrateTable<CrateField>()
  /// Field indices; each set is terminated by `endOfSet`.
  private var fieldSets: [UInt32] = []
  private var fieldSetStarts: [[UInt32]: Int] = [:]
  private var specs: [Spec] = []
  private var sections: [(name: String, start: Int, size: Int)] = []

  init() {
    var file = ByteWriter(capacity: 1 << 20)
    file.append("PXR-USDC")
    file.append(contentsOf: Self.version)
    file.append(contentsOf: [UInt8](repeating: 0, count: Self.headerSize - file.count))
    values = CrateValues(file: file)
  }

  // MARK: Specs

  mutating func add(_ layer: USDLayer) {
    var fields = [("defaultPrim", values.store(.token(layer.defaultPrim)))]
    for field in layer.metadata { fields.append((field.name, values.store(field.value))) }
    fields.append(("primChildren", values.storeNames(layer.prims.map(\.name))))
    addSpec("/", .pseudoRoot, fields)
    for prim in layer.prims { add(prim, below: "") }
  }

  private mutating func add(_ prim: USDPrim, below parent: String) {
    let path = "\(parent)/\(prim.name)"
    let specifier: UInt32 =
      switch prim.specifier {
      case .def: 0
      case .over: 1
      case .class: 2
      }
    var fields = [("specifier", CrateValueRep.inlined(.specifier, specifier))]
    if !prim.typeName.isEmpty { fields.append(("typeName", values.store(.token(prim.typeName)))) }
    if !prim.apiSchemas.isEmpty {
      fields.append(("apiSchemas", values.storePrepended(prim.apiSchemas)))
    }
    for field in prim.metadata { fields.append((field.name, values.store(field.value))) }
    if !prim.properties.isEmpty {
      fields.append(("properties", values.storeNames(prim.properties.map(\.name))))
    }
    if !prim.children.isEmpty {
      fields.append(("primChildren", values.storeNames(prim.children.map(\.name))))
    }
    addSpec(path, .prim, fields)
    for property in prim.properties { add(property, of: path) }
    for child in prim.children { add(child, below: path) }
  }

  private mutating func add(_ property: USDProperty, of prim: String) {
    var fields: [(String, CrateValueRep)] = []
    let type: CrateSpecType
    switch property.content {
    case .attribute(let typeName, let value, let connections):
      type = .attribute
      fields.append(("typeName", values.store(.token(typeName))))
      if let value { fields.append(("default", values.store(value))) }
      if !connections.isEmpty {
        fields.append(("connectionPaths", values.storeExplicit(paths: connections)))
      }
    case .relationship(let targets):
      type = .relationship
      fields.append(("targetPaths", values.storeExplicit(paths: targets)))
    }
    if property.isUniform { fields.append(("variability", .inlined(.variability, 1))) }
    for field in property.metadata { fields.append((field.name, values.store(field.value))) }
    addSpec("\(prim).\(property.name)", type, fields)
  }

  private mutating func addSpec(
    _ path: String, _ type: CrateSpecType, _ entries: [(String, CrateValueRep)]
  ) {
    let set = entries.map { name, value in
      fields.index(CrateField(token: values.tokens.index(name), value: value))
    }
    let start = fieldSetStarts[set] ?? fieldSets.count
    if fieldSetStarts.updateValue(start, forKey: set) == nil {
      fieldSets += set + [Self.endOfSet]
    }
    let index = values.paths.index(path, &values.tokens)
    specs.append(Spec(path: index, fieldSet: start, type: type))
  }

  // MARK: Sections

  /// Writes the sections and the table of contents.
  mutating func finish() -> [UInt8] {
    section("TOKENS") { writer in
      let elements = writer.values.tokens.elements
      let text: [UInt8] = elements.flatMap { $0.utf8 + [0] }
      let compressed = CrateCompression.compress(text)
      writer.values.file.append(UInt64(elements.count))
      writer.values.file.append(UInt64(text.count))
      writer.appendCounted(compressed)
    }
    section("STRINGS") { writer in
      writer.values.file.append(UInt64(writer.values.strings.elements.count))
      for token in writer.values.strings.elements { writer.values.file.append(token) }
    }
    section("FIELDS") { writer in
      let fields = writer.fields.elements
      writer.values.file.append(UInt64(fields.count))
      writer.appendIntegers(fields.map { Int32(bitPattern: $0.token) })
      var representations = ByteWriter(capacity: fields.count * 8)
      for field in fields { representations.append(field.value.bits) }
      writer.appendCounted(CrateCompression.compress(representations.bytes))
    }
    section("FIELDSETS") { writer in
      writer.values.file.append(UInt64(writer.fieldSets.count))
      writer.appendIntegers(writer.fieldSets.map { Int32(bitPattern: $0) })
    }
    section("PATHS") { writer in
      let encoded = writer.values.paths.encoded()
      writer.values.file.append(UInt64(encoded.paths.count))
      writer.values.file.append(UInt64(encoded.paths.count))
      writer.appendIntegers(encoded.paths)
      writer.appendIntegers(encoded.tokens)
      writer.appendIntegers(encoded.jumps)
    }
    section("SPECS") { writer in
      writer.values.file.append(UInt64(writer.specs.count))
      writer.appendIntegers(writer.specs.map { Int32($0.path) })
      writer.appendIntegers(writer.specs.map { Int32($0.fieldSet) })
      writer.appendIntegers(writer.specs.map { $0.type.rawValue })
    }
    values.file.replace(at: Self.contentsOffset, with: Int64(values.file.count))
    values.file.append(UInt64(sections.count))
    for section in sections {
      let name = Array(section.name.utf8)
      values.file.append(
        contentsOf: name + [UInt8](repeating: 0, count: Self.sectionNameSize - name.count))
      values.file.append(Int64(section.start))
      values.file.append(Int64(section.size))
    }
    return values.file.bytes
  }

  private mutating func section(_ name: String, _ body: (inout CrateWriter) -> Void) {
    let start = values.file.count
    body(&self)
    sections.append((name, start, values.file.count - start))
  }

  private mutating func appendCounted(_ bytes: [UInt8]) {
    values.file.append(UInt64(bytes.count))
    values.file.append(contentsOf: bytes)
  }

  private mutating func appendIntegers(_ integers: [Int32]) {
    appendCounted(CrateCompression.compress(integers))
  }
}
