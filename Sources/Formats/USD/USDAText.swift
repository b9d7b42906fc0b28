import SceneModel

/// Writes a layer in USD's text format (.usda).
package enum USDAText {
  /// The text of `layer`.
  package static func encode(_ layer: USDLayer) -> String {
    var writer = TextWriter()
    writer.line("#usda 1.0")
    writer.line("(")
    writer.indented {
      $0.line("defaultPrim = \(quoted(layer.defaultPrim))")
      for field in layer.metadata { $0.metadata(field) }
    }
    writer.line(")")
    for prim in layer.prims {
      writer.line("")
      writer.prim(prim)
    }
    return writer.text
  }

  /// A quoted string with special characters escaped.
  static func quoted(_ text: String) -> String {
    var result = "\""
    for scalar in text.unicodeScalars {
      switch scalar {
      case "\"": result += "\\\""
      case "\\": result += "\\\\"
      case "\n": result += "\\n"
      case "\r": result += "\\r"
      case "\t": result += "\\t"
      default: result.unicodeScalars.append(scalar)
      }
    }
    return result + "\""
  }

  /// A value in the text format; empty for dictionaries, which `TextWriter` writes in several
  /// lines.
  static func text(_ value: USDValue) -> String {
    switch value {
    case .bool(let value): value ? "true" : "false"
    case .int(let value): "\(value)"
    case .float(let value): number(value)
    case .double(let value): number(value)
    case .token(let value), .string(let value): quoted(value)
    case .asset(let path): "@\(path)@"
    case .float2(let v): tuple([v.x, v.y])
    case .float3(let v): tuple([v.x, v.y, v.z])
    case .float4(let v): tuple([v.x, v.y, v.z, v.w])
    case .double3(let v): tuple([v.x, v.y, v.z])
    case .matrix4(let m):
      "( " + (0..<4).map { tuple(Array(m[4 * $0..<4 * $0 + 4])) }.joined(separator: ", ") + " )"
    case .tokenArray(let values): list(values) { quoted($0) }
    case .intArray(let values): list(values) { "\($0)" }
    case .floatArray(let values): list(values) { number($0) }
    case .float2Array(let values): list(values) { tuple([$0.x, $0.y]) }
    case .float3Array(let values): list(values) { tuple([$0.x, $0.y, $0.z]) }
    case .float4Array(let values): list(values) { tuple([$0.x, $0.y, $0.z, $0.w]) }
    case .references(let references):
      list(references) { "@\($0.asset)@" + ($0.path.isEmpty ? "" : "<\($0.path)>") }
    case .dictionary: ""
    }
  }

  /// The shortest decimal that parses back to the same number; whole numbers without a point.
  private static func number(_ value: some BinaryFloatingPoint & LosslessStringConvertible)
    -> String
  {
    guard value.isFinite else { return value.isNaN ? "nan" : value < 0 ? "-inf" : "inf" }
    let text = "\(value)"
    return text.hasSuffix(".0") ? String(text.dropLast(2)) : text
  }

  private static func tuple(_ values: [some BinaryFloatingPoint & LosslessStringConvertible])
    -> String
  {
    "(" + values.map { number($0) }.joined(separator: ", ") + ")"
  }

  private static func list<T>(_ values: [T], _ text: (T) -> String) -> String {
    "[" + values.map(text).joined(separator: ", ") + "]"
  }
}

/// Builds text from indented lines.
private struct TextWriter {
  var text = ""
  var indentation = 0

  mutating func line(_ content: String) {
    if !content.isEmpty {
      text += String(repeating: "    ", count: indentation)
      text += content
    }
    text += "\n"
  }

  mutating func indented(_ body: (inout TextWriter) -> Void) {
    indentation += 1
    body(&self)
    indentation -= 1
  }

  mutating func metadata(_ field: USDField) {
    guard case .dictionary(let entries) = field.value else {
      return line("\(field.name) = \(USDAText.text(field.value))")
    }
    dictionary("\(field.name) = ", entries)
  }

  private mutating func dictionary(_ head: String, _ entries: [USDField]) {
    line(head + "{")
    indented {
      for entry in entries {
        if case .dictionary(let nested) = entry.value {
          $0.dictionary("dictionary \(USDAText.quoted(entry.name)) = ", nested)
        } else {
          let type = entry.value.typeName
          $0.line("\(type) \(USDAText.quoted(entry.name)) = \(USDAText.text(entry.value))")
        }
      }
    }
    line("}")
  }

  mutating func prim(_ prim: USDPrim) {
    let type = prim.typeName.isEmpty ? "" : " \(prim.typeName)"
    let head = "\(prim.specifier.rawValue)\(type) \(USDAText.quoted(prim.name))"
    if prim.apiSchemas.isEmpty, prim.metadata.isEmpty {
      line(head)
    } else {
      line(head + " (")
      indented {
        if !prim.apiSchemas.isEmpty {
          $0.line("prepend apiSchemas = \(USDAText.text(.tokenArray(prim.apiSchemas)))")
        }
        for field in prim.metadata { $0.metadata(field) }
      }
      line(")")
    }
    line("{")
    indented { writer in
      for property in prim.properties { writer.property(property) }
      for (index, child) in prim.children.enumerated() {
        if index > 0 || !prim.properties.isEmpty { writer.line("") }
        writer.prim(child)
      }
    }
    line("}")
  }

  private mutating func property(_ property: USDProperty) {
    switch property.content {
    case .relationship(let targets):
      line("\(property.isUniform ? "" : "varying ")rel \(property.name) = \(paths(targets))")
    case .attribute(let typeName, let value, let connections):
      let head = "\(property.isUniform ? "uniform " : "")\(typeName) \(property.name)"
      if value != nil || connections.isEmpty {
        let assignment = value.map { " = \(USDAText.text($0))" } ?? ""
        if property.metadata.isEmpty {
          line(head + assignment)
        } else {
          line(head + assignment + " (")
          indented { for field in property.metadata { $0.metadata(field) } }
          line(")")
        }
      }
      if !connections.isEmpty { line("\(head).connect = \(paths(connections))") }
    }
  }

  private func paths(_ paths: [String]) -> String {
    paths.count == 1
      ? "<\(paths[0])>" : "[" + paths.map { "<\($0)>" }.joined(separator: ", ") + "]"
  }
}

extension USDValue {
  /// The name of the value's type in the text format.
  var typeName: String {
    switch self {
    case .bool: "bool"
    case .int: "int"
    case .float: "float"
    case .double: "double"
    case .token: "token"
    case .string: "string"
    case .asset: "asset"
    case .float2: "float2"
    case .float3: "float3"
    case .float4: "float4"
    case .double3: "double3"
    case .matrix4: "matrix4d"
    case .tokenArray: "token[]"
    case .intArray: "int[]"
    case .floatArray: "float[]"
    case .float2Array: "float2[]"
    case .float3Array: "float3[]"
    case .float4Array: "float4[]"
    case .dictionary: "dictionary"
    case .references: "references"
    }
  }
}
