/// The content of a USD layer, independent of the file format (text or crate).
package struct USDLayer: Equatable, Sendable {
  /// Layer metadata such as `upAxis`, except the default prim.
  package var metadata: [USDField]
  /// The name of the root prim that a reference to the layer targets.
  package var defaultPrim: String
  /// The root prims.
  package var prims: [USDPrim]

  package init(metadata: [USDField], defaultPrim: String, prims: [USDPrim]) {
    self.metadata = metadata
    self.defaultPrim = defaultPrim
    self.prims = prims
  }
}

/// A prim: a typed node with properties and children.
package struct USDPrim: Equatable, Sendable {
  /// Whether the prim defines something, overrides a prim defined elsewhere, or is a class.
  package enum Specifier: String, Sendable { case def, over, `class` }

  package var specifier: Specifier = .def
  /// The schema type, such as `Mesh`; empty for an untyped prim.
  package var typeName: String
  package var name: String
  /// API schemas, prepended to those of weaker layers.
  package var apiSchemas: [String] = []
  /// Metadata such as `kind` and `assetInfo`.
  package var metadata: [USDField] = []
  /// Attributes and relationships, in file order.
  package var properties: [USDProperty] = []
  package var children: [USDPrim] = []

  package init(_ typeName: String, _ name: String) {
    self.typeName = typeName
    self.name = name
  }
}

/// An attribute or a relationship of a prim.
package struct USDProperty: Equatable, Sendable {
  /// Kind and value of a property.
  package enum Content: Equatable, Sendable {
    /// `connections` are absolute paths of attributes.
    case attribute(typeName: String, value: USDValue?, connections: [String])
    /// Absolute paths.
    case relationship(targets: [String])
  }

  package var name: String
  /// Whether the value is constant over time (USD's variability).
  package var isUniform: Bool
  package var content: Content
  /// Metadata such as `interpolation`.
  package var metadata: [USDField]

  /// An attribute, without a value if `value` is nil.
  package static func attribute(
    _ typeName: String, _ name: String, _ value: USDValue? = nil, isUniform: Bool = false,
    metadata: [USDField] = []
  ) -> USDProperty {
    USDProperty(
      name: name, isUniform: isUniform,
      content: .attribute(typeName: typeName, value: value, connections: []), metadata: metadata)
  }

  /// An attribute connected to the attribute at `source`.
  package static func connection(
    _ typeName: String, _ name: String, to source: String
  ) -> USDProperty {
    USDProperty(
      name: name, isUniform: false,
      content: .attribute(typeName: typeName, value: nil, connections: [source]), metadata: [])
  }

  /// A relationship to the prims or properties at `targets`.
  package static func relationship(_ name: String, _ targets: [String]) -> USDProperty {
    USDProperty(
      name: name, isUniform: true, content: .relationship(targets: targets), metadata: [])
  }
}
