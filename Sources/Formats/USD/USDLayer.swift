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
