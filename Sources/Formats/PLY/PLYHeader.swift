/// The header of a PLY file.
struct PLYHeader {
  enum Encoding: String {
    case ascii
    case littleEndian = "binary_little_endian"
    case bigEndian = "binary_big_endian"
  }

  enum ScalarType {
    case int8, uint8, int16, uint16, int32, uint32, float32, float64

    /// Accepts both naming schemes in use.
    init?(_ name: Substring) {
      switch name {
      case "char", "int8": self = .int8
      case "uchar", "uint8": self = .uint8
      case "short", "int16": self = .int16
      case "ushort", "uint16": self = .uint16
      case "int", "int32": self = .int32
      case "uint", "uint32": self = .uint32
      case "float", "float32": self = .float32
      case "double", "float64": self = .float64
      default: return nil
      }
    }

    var size: Int {
      switch self {
      case .int8, .uint8: 1
      case .int16, .uint16: 2
      case .int32, .uint32, .float32: 4
      case .float64: 8
      }
    }
  }

  struct Property {
    var name: String
    var type: ScalarType
    /// The type of the length if the property is a list.
    var countType: ScalarType?
  }

  struct Element {
    var name: String
    var count: Int
    var properties: [Property] = []

    /// Minimum bytes of one row.
    func minimumRowSize(_ encoding: Encoding) -> Int {
      guard encoding != .ascii else { return max(1, 2 * properties.count - 1) }
      return max(1, properties.reduce(0) { $0 + ($1.countType ?? $1.type).size })
    }

    func index(of name: String) -> Int? {
      properties.firstIndex { $0.name == name && $0.countType == nil }
    }

    func listIndex(of names: String...) -> Int? {
      properties.firstIndex { names.contains($0.name) && $0.countType != nil }
    }
  }

  var encoding: Encoding
  var elements: [Element]
  /// Bytes of the header including its last line break.
  var length: Int
}

extension PLYHeader {
  /// Longer headers are rejected. Chosen.
  private static let maximumLength = 1 << 16

  /// Parses a header; throws a `FormatFault`.
  init(_ bytes: [UInt8]) throws {
    let (lines, length) = try Self.lines(of: bytes)
    guard lines.first == "ply" else { throw FormatFault("it does not begin with 'ply'") }
    var encoding: Encoding?
    var elements: [Element] = []
    for line in lines.dropFirst() {
      let words = line.split(whereSeparator: { $0 == " " || $0 == "\t" })
      switch words.first {
      case "format" where words.count == 3:
        encoding = Encoding(rawValue: String(words[1]))
      case "element" where words.count == 3:
        guard let count = Int(words[2]), count >= 0 else {
          throw FormatFault("the element count '\(words[2])' is not a number")
        }
        guard !elements.contains(where: { $0.name == words[1] }) else {
          throw FormatFault("it has two elements with the name '\(words[1])'")
        }
        elements.append(Element(name: String(words[1]), count: count))
      case "property":
        guard !elements.isEmpty, let property = Self.property(words) else {
          throw FormatFault("the header line '\(line)' is not valid")
        }
        elements[elements.count - 1].properties.append(property)
      case "comment", "obj_info", nil: break
      default: throw FormatFault("the header line '\(line)' is not valid")
      }
    }
    guard let encoding else { throw FormatFault("it has no known format line") }
    self.init(encoding: encoding, elements: elements, length: length)
  }

  private static func lines(of bytes: [UInt8]) throws -> (lines: [String], length: Int) {
    var lines: [String] = []
    var start = 0
    while start < min(bytes.count, maximumLength) {
      guard let end = bytes[start...].prefix(maximumLength).firstIndex(of: 10) else { break }
      let line = String(decoding: bytes[start..<end], as: UTF8.self)
        .trimmingSuffix { $0 == "\r" || $0 == " " }
      start = end + 1
      if line == "end_header" { return (lines, start) }
      lines.append(line)
    }
    throw FormatFault("its header has no end")
  }

  private static func property(_ words: [Substring]) -> Property? {
    if words.count == 3, let type = ScalarType(words[1]) {
      return Property(name: String(words[2]), type: type)
    }
    guard words.count == 5, words[1] == "list", let count = ScalarType(words[2]),
      let type = ScalarType(words[3])
    else { return nil }
    return Property(name: String(words[4]), type: type, countType: count)
  }
}

extension String {
  func trimmingSuffix(while predicate: (Character) -> Bool) -> String {
    var text = self[...]
    while let last = text.last, predicate(last) { text.removeLast() }
    return String(text)
  }
}
