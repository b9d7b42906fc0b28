import SceneModel

extension USDPrim {
  /// The value of a metadata field.
  func metadata(_ name: String) -> USDValue? { metadata.first { $0.name == name }?.value }

  /// The property of a name.
  func property(_ name: String) -> USDProperty? { properties.first { $0.name == name } }

  /// The value of an attribute.
  func value(_ name: String) -> USDValue? { property(name)?.value }

  /// The targets of a relationship, or the connections of an attribute.
  func targets(_ name: String) -> [String] { property(name)?.targets ?? [] }

  /// The prim with all targets of it and its children mapped.
  func mapped(target: (String) -> String) -> USDPrim {
    var result = self
    result.properties = properties.map { $0.mapped(target: target, file: { $0 }) }
    result.children = children.map { $0.mapped(target: target) }
    return result
  }
}

extension USDProperty {
  /// The value of an attribute.
  var value: USDValue? {
    guard case .attribute(_, let value, _) = content else { return nil }
    return value
  }

  /// The targets of a relationship, or the connections of an attribute.
  var targets: [String] {
    switch content {
    case .attribute(_, _, let connections): connections
    case .relationship(let targets): targets
    }
  }

  /// Whether it has a value, connection or target.
  var hasContent: Bool { value != nil || !targets.isEmpty }

  /// The value of a metadata field.
  func metadata(_ name: String) -> USDValue? { metadata.first { $0.name == name }?.value }

  /// The property with its targets, and a path of a file, mapped.
  func mapped(target: (String) -> String, file: (String) -> String) -> USDProperty {
    var result = self
    switch content {
    case .attribute(let type, .asset(let path), let connections):
      result.content = .attribute(
        typeName: type, value: .asset(file(path)), connections: connections.map(target))
    case .attribute(_, _, let connections) where connections.isEmpty: break
    case .attribute(let type, let value, let connections):
      result.content = .attribute(
        typeName: type, value: value, connections: connections.map(target))
    case .relationship(let targets):
      result.content = .relationship(targets: targets.map(target))
    }
    return result
  }
}

extension USDValue {
  /// The text of a token or string.
  var text: String? {
    switch self {
    case .token(let text), .string(let text): text
    default: nil
    }
  }

  var number: Double? {
    switch self {
    case .int(let value): Double(value)
    case .float(let value): Double(value)
    case .double(let value): value
    default: nil
    }
  }

  /// The components of a vector.
  var vector: [Double]? {
    switch self {
    case .float2(let v): [Double(v.x), Double(v.y)]
    case .float3(let v): [Double(v.x), Double(v.y), Double(v.z)]
    case .float4(let v): [Double(v.x), Double(v.y), Double(v.z), Double(v.w)]
    case .double3(let v): [v.x, v.y, v.z]
    default: nil
    }
  }
}
