import Foundation

/// An element of an XML document, as far as data files need it: names, attributes, text, children.
///
/// Foundation's parser would bring libxml2 into the program for the few files that need it.
struct XMLElement: Equatable {
  var name: String
  var attributes: [String: String] = [:]
  var children: [XMLElement] = []
  /// The text directly in the element.
  var text = ""

  /// The first child of the name.
  func child(_ name: String) -> XMLElement? { children.first { $0.name == name } }

  /// All children of the name.
  func children(_ name: String) -> [XMLElement] { children.filter { $0.name == name } }

  /// The numbers in the text, separated by blanks; nil if a word is no finite number.
  var numbers: [Double]? {
    let words = text.split(whereSeparator: \.isWhitespace)
    let numbers = words.compactMap { Double($0) }.filter(\.isFinite)
    return numbers.count == words.count ? numbers : nil
  }

  /// The number in the text of the child `name`.
  func number(_ name: String) -> Double? {
    guard let numbers = child(name)?.numbers, numbers.count == 1 else { return nil }
    return numbers[0]
  }
}

extension XMLElement {
  /// The root element of a document in UTF-8; throws a `FormatFault`.
  static func parse(_ bytes: [UInt8]) throws -> XMLElement {
    var parser = XMLParser(bytes)
    return try parser.document()
  }
}

/// Parses XML 1.0 without document types: entities other than the five predefined ones and
/// characters by number are rejected, so that no document can expand.
private struct XMLParser {
  /// Deeper elements are rejected, since the stack of a thread is limited. Chosen.
  private static let maximumDepth = 128

  private let bytes: [UInt8]
  private var offset = 0

  init(_ bytes: [UInt8]) {
    self.bytes = bytes.starts(with: [0xEF, 0xBB, 0xBF]) ? Array(bytes.dropFirst(3)) : bytes
  }

  mutating func document() throws -> XMLElement {
    try skipMisc()
    guard peek == UInt8(ascii: "<") else { throw FormatFault("it is not XML") }
    return try element(depth: 0)
  }

  private var peek: UInt8? { offset < bytes.count ? bytes[offset] : nil }

  private func starts(with text: String) -> Bool {
    bytes[offset...].starts(with: text.utf8)
  }

  private mutating func skipBlanks() {
    while let byte = peek, [9, 10, 13, 32].contains(byte) { offset += 1 }
  }

  /// Skips blanks, comments and processing instructions.
  private mutating func skipMisc() throws {
    while true {
      skipBlanks()
      if starts(with: "<!--") {
        _ = try text(upTo: "-->")
      } else if starts(with: "<?") {
        _ = try text(upTo: "?>")
      } else {
        return
      }
    }
  }

  /// The bytes before `end`, which is skipped.
  private mutating func text(upTo end: String) throws -> ArraySlice<UInt8> {
    let (start, end) = (offset, Array(end.utf8))
    while offset + end.count <= bytes.count {
      if bytes[offset...].starts(with: end) {
        defer { offset += end.count }
        return bytes[start..<offset]
      }
      offset += 1
    }
    throw FormatFault("it ends inside of an element")
  }

  private mutating func name() throws -> String {
    let start = offset
    let ends = Set(" \t\r\n/>=<".utf8)
    while let byte = peek, !ends.contains(byte) { offset += 1 }
    guard offset > start else { throw FormatFault("an element has no name") }
    return String(decoding: bytes[start..<offset], as: UTF8.self)
  }

  private mutating func element(depth: Int) throws -> XMLElement {
    guard depth < Self.maximumDepth else { throw FormatFault("its elements are nested too deeply") }
    offset += 1
    var element = XMLElement(name: try name())
    while true {
      skipBlanks()
      guard let byte = peek else { throw FormatFault("it ends inside of an element") }
      if starts(with: "/>") {
        offset += 2
        return element
      }
      if byte == UInt8(ascii: ">") {
        offset += 1
        try readContent(of: &element, depth: depth)
        return element
      }
      try readAttribute(of: &element)
    }
  }

  private mutating func readAttribute(of element: inout XMLElement) throws {
    let key = try name()
    skipBlanks()
    guard peek == UInt8(ascii: "=") else { throw FormatFault("attribute \(key) has no value") }
    offset += 1
    skipBlanks()
    guard let quote = peek, [UInt8(ascii: "\""), UInt8(ascii: "'")].contains(quote) else {
      throw FormatFault("attribute \(key) has no value")
    }
    offset += 1
    let value = try text(upTo: String(UnicodeScalar(quote)))
    element.attributes[key] = try Self.unescaped(value)
  }

  private mutating func readContent(of element: inout XMLElement, depth: Int) throws {
    while true {
      let start = offset
      while let byte = peek, byte != UInt8(ascii: "<") { offset += 1 }
      element.text += try Self.unescaped(bytes[start..<offset])
      if starts(with: "</") {
        offset += 2
        guard try name() == element.name else {
          throw FormatFault("element \(element.name) is not closed")
        }
        _ = try text(upTo: ">")
        return
      }
      if starts(with: "<!--") || starts(with: "<?") {
        try skipMisc()
      } else if starts(with: "<![CDATA[") {
        offset += 9
        element.text += String(decoding: try text(upTo: "]]>"), as: UTF8.self)
      } else if peek != nil {
        element.children.append(try self.element(depth: depth + 1))
      } else {
        throw FormatFault("it ends inside of an element")
      }
    }
  }

  private static let entities = ["lt": "<", "gt": ">", "amp": "&", "quot": "\"", "apos": "'"]

  private static func unescaped(_ bytes: ArraySlice<UInt8>) throws -> String {
    let text = String(decoding: bytes, as: UTF8.self)
    guard text.contains("&") else { return text }
    var pieces = text.split(separator: "&", omittingEmptySubsequences: false)[...]
    var result = String(pieces.removeFirst())
    for piece in pieces {
      let parts = piece.split(separator: ";", maxSplits: 1, omittingEmptySubsequences: false)
      guard parts.count == 2, let character = character(parts[0]) else {
        throw FormatFault("'&\(piece.prefix(12))' is no predefined entity")
      }
      result += character + parts[1]
    }
    return result
  }

  private static func character(_ name: Substring) -> String? {
    if let text = entities[String(name)] { return text }
    let number =
      name.hasPrefix("#x") ? UInt32(name.dropFirst(2), radix: 16) : UInt32(name.dropFirst())
    guard name.hasPrefix("#"), let scalar = number.flatMap(UnicodeScalar.init) else { return nil }
    return String(Character(scalar))
  }
}
