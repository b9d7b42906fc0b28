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
