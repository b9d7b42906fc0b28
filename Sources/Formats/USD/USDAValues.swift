import SceneModel

/// The parts of a value in USD's text, by kind, without their brackets.
struct USDAValues {
  var numbers: [Double] = []
  var strings: [String] = []
  var paths: [String] = []
  var references: [USDReference] = []
  private var words: [String] = []
  /// Whether the outermost brackets are square.
  var isList = false
  var isNone = false

  mutating func append(word: String) { words.append(word) }

  /// Adds a path: that of the preceding reference, if it has none.
  mutating func append(path: String) {
    if let last = references.indices.last, references[last].path.isEmpty {
      references[last].path = path
    } else {
      paths.append(path)
    }
  }

  /// The value of an attribute of the type `typeName`; nil if this module doesn't use the type.
  func value(of typeName: String) -> USDValue? {
    guard !isNone else { return nil }
    let isArray = typeName.hasSuffix("[]")
    let name = isArray ? String(typeName.dropLast(2)) : typeName
    let type = CompoundType(name)
    switch type.scalar {
    case "int", "uint", "int64", "uint64", "uchar":
      guard type.width == 1 else { return nil }
      let integers = numbers.map { Self.integer($0) }
      return isArray ? .intArray(integers) : integers.first.map { .int($0) }
    case "bool":
      return numbers.first.map { .bool($0 != 0) } ?? words.first.map { .bool($0 == "true") }
    case "half", "float", "double": return isArray ? array(type) : single(type)
    case "token": return isArray ? .tokenArray(strings) : strings.first.map { .token($0) }
    case "string": return isArray ? .tokenArray(strings) : strings.first.map { .string($0) }
    case "asset": return isArray ? nil : references.first.map { .asset($0.asset) }
    default: return nil
    }
  }

  /// The value of a field of metadata, whose type depends on its name.
  func metadataValue(of name: String) -> USDValue? {
    switch name {
    case "references", "payload":
      let internalReferences = paths.map { USDReference(asset: "", path: $0) }
      return .references(references + internalReferences)
    case "inherits": return .references(paths.map { USDReference(asset: "", path: $0) })
    case "subLayers": return .tokenArray(references.map(\.asset))
    default: break
    }
    if isList || strings.count > 1 { return strings.isEmpty ? nil : .tokenArray(strings) }
    if let text = strings.first { return .string(text) }
    if let number = numbers.first { return numbers.count == 1 ? .double(number) : nil }
    return ["true", "false"].contains(words.first) ? .bool(words.first == "true") : nil
  }

  private static func integer(_ value: Double) -> Int32 {
    value.isFinite ? Int32(max(-2_147_483_648, min(2_147_483_647, value))) : 0
  }

  private func single(_ type: CompoundType) -> USDValue? {
    guard numbers.count == type.width else { return nil }
    let v = numbers.map { Float($0) }
    switch type.width {
    case 1: return type.scalar == "double" ? .double(numbers[0]) : .float(v[0])
    case 2: return .float2([v[0], v[1]])
    case 3:
      return type.scalar == "double"
        ? .double3([numbers[0], numbers[1], numbers[2]]) : .float3([v[0], v[1], v[2]])
    // The text has the real part of a quaternion first.
    case 4:
      return .float4(type.isQuaternion ? [v[1], v[2], v[3], v[0]] : [v[0], v[1], v[2], v[3]])
    case 16: return .matrix4(numbers)
    default: return nil
    }
  }

  private func array(_ type: CompoundType) -> USDValue? {
    let (n, width) = (numbers, type.width)
    guard n.count % width == 0 else { return nil }
    let starts = stride(from: 0, to: n.count, by: width)
    switch width {
    case 1: return .floatArray(n.map { Float($0) })
    case 2: return .float2Array(starts.map { SIMD2(Float(n[$0]), Float(n[$0 + 1])) })
    case 3:
      return .float3Array(
        starts.map { SIMD3(Float(n[$0]), Float(n[$0 + 1]), Float(n[$0 + 2])) })
    case 4:
      return .float4Array(
        starts.map { SIMD4(Float(n[$0]), Float(n[$0 + 1]), Float(n[$0 + 2]), Float(n[$0 + 3])) })
    default: return nil
    }
  }
}

/// The scalar type and the number of components of a type of USD's text.
private struct CompoundType {
  private static let scalars = ["h": "half", "f": "float", "d": "double"]

  var scalar: String
  var width = 1
  var isQuaternion = false

  init(_ name: String) {
    scalar = name
    if name == "matrix4d" {
      (scalar, width) = ("double", 16)
    } else if ["int64", "uint64"].contains(name) {
      return
    } else if let last = name.last, let type = Self.scalars[String(last)],
      name.hasPrefix("quat") && name.count == 5
    {
      (scalar, width, isQuaternion) = (type, 4, true)
    } else if let last = name.last, let digit = name.dropLast().last?.wholeNumberValue,
      let type = Self.scalars[String(last)]
    {
      // A role with its width, such as point3f.
      (scalar, width) = (type, max(digit, 1))
    } else if let digit = name.last?.wholeNumberValue {
      (scalar, width) = (String(name.dropLast()), max(digit, 1))
    }
  }
}
