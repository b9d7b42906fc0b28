/// A reference to a prim, whose content another prim includes.
package struct USDReference: Equatable, Sendable {
  /// The layer, relative to the one with the reference; empty for the same layer.
  package var asset: String
  /// The path of the prim; empty for the default prim of the layer.
  package var path: String

  package init(asset: String, path: String) {
    self.asset = asset
    self.path = path
  }
}
