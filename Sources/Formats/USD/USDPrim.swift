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
