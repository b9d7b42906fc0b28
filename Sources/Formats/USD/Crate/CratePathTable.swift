/// The paths of a crate file as a forest of nodes; see `CratePaths.encoded` for the coding.
struct CratePathTable {
  struct Node {
    /// The index of the parent; nil for the root, and for paths that the file doesn't define.
    var parent: Int?
    /// The token of the last element.
    var token = 0
    var isProperty = false
    /// Number of ancestors.
    var depth = 0
  }

  /// Deeper paths are rejected. Chosen: USDA and glTF have the same limit.
  static let maximumDepth = 128

  private(set) var nodes: [Node]
  /// The index of the root; nil if the file has no paths.
  private(set) var root: Int?

  /// `paths` has indices below `count`. Throws a `FormatFault`.
  init(count: Int, paths: [UInt32], tokens: [Int32], jumps: [Int32]) throws {
    nodes = [Node](repeating: Node(), count: count)
    var isDefined = [Bool](repeating: false, count: count)
    // The positions of siblings that are yet to be visited, with their parents.
    var pending: [(position: Int, parent: Int?)] = paths.isEmpty ? [] : [(0, nil)]
    while var (position, parent) = pending.popLast() {
      while true {
        guard paths.indices.contains(position) else { throw FormatFault("its paths are damaged") }
        let path = Int(paths[position])
        // A second visit would be a circle.
        guard !isDefined[path] else { throw FormatFault("its paths are damaged") }
        isDefined[path] = true
        try define(path, parent: parent, token: Int(tokens[position]))
        let jump = Int(jumps[position])
        let hasChild = jump > 0 || jump == -1
        if hasChild, jump > 0 { pending.append((position + jump, parent)) }
        guard hasChild || jump == 0 else { break }
        if hasChild { parent = path }
        position += 1
      }
    }
  }

  private mutating func define(_ path: Int, parent: Int?, token: Int) throws {
    guard let parent else {
      guard root == nil else { throw FormatFault("its paths have two roots") }
      root = path
      return
    }
    let depth = nodes[parent].depth + 1
    guard depth <= Self.maximumDepth else { throw FormatFault("its prims are nested too deeply") }
    nodes[path] = Node(
      parent: parent, token: Int(token.magnitude), isProperty: token < 0, depth: depth)
  }

  /// The absolute path of a node.
  func text(of path: Int, tokens: [String], budget: MemoryBudget) throws -> String {
    guard nodes.indices.contains(path) else {
      throw FormatFault("a path index is out of range")
    }
    var elements: [String] = []
    var node = nodes[path]
    while let parent = node.parent {
      elements.append((node.isProperty ? "." : "/") + tokens[node.token])
      node = nodes[parent]
    }
    try budget.spend(elements.reduce(0) { $0 + $1.utf8.count })
    return elements.isEmpty ? "/" : elements.reversed().joined()
  }
}
