/// The path of a prim or property, as a node of a tree that is stored depth first.
struct CratePath {
  /// The token of the last path element; the root has none.
  var token: UInt32
  var isProperty: Bool
  var children: [Int] = []
}
