/// All paths of a layer as a tree; indices are in order of creation, the root is 0.
struct CratePaths {
  private(set) var nodes: [CratePath] = [CratePath(token: 0, isProperty: false)]
  private var indices: [String: Int] = ["/": 0]

  /// The index of the absolute path `path` of a prim or property; adds it and its parents if new.
  mutating func index(_ path: String, _ tokens: inout CrateTable<String>) -> Int {
    if let index = indices[path] { return index }
    let lastSlash = path.lastIndex(of: "/") ?? path.startIndex
    let dot = path[lastSlash...].firstIndex(of: ".")
    let split = dot ?? lastSlash
    let parentPath = split == path.startIndex ? "/" : String(path[..<split])
    let parent = index(parentPath, &tokens)
    let name = String(path[path.index(after: split)...])
    let index = nodes.count
    nodes.append(CratePath(token: tokens.index(name), isProperty: dot != nil))
    nodes[parent].children.append(index)
    indices[path] = index
    return index
  }

  /// The tree in depth-first order as three parallel arrays.
  ///
  /// A jump of 0 means that only a sibling follows, −1 only a child, −2 neither; a positive jump
  /// means that a child follows, and is the distance to the sibling. Property tokens are negative.
  func encoded() -> (paths: [Int32], tokens: [Int32], jumps: [Int32]) {
    var paths: [Int32] = []
    var tokens: [Int32] = []
    var jumps: [Int32] = []
    func visit(_ index: Int, hasSibling: Bool) {
      let node = nodes[index]
      let position = paths.count
      paths.append(Int32(index))
      tokens.append(node.isProperty ? -Int32(node.token) : Int32(node.token))
      jumps.append(hasSibling ? 0 : -2)
      for (order, child) in node.children.enumerated() {
        visit(child, hasSibling: order + 1 < node.children.count)
      }
      if !node.children.isEmpty {
        jumps[position] = hasSibling ? Int32(paths.count - position) : -1
      }
    }
    visit(0, hasSibling: false)
    return (paths, tokens, jumps)
  }
}
