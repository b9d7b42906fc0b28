/// The prims of a stage with their paths, in the order of the file.
struct PrimTable {
  private(set) var entries: [(path: String, prim: USDPrim)] = []
  private var indices: [String: Int] = [:]

  /// Throws a `FormatFault` if they take too much memory.
  init(_ stage: USDStage, budget: MemoryBudget) throws {
    func add(_ prim: USDPrim, at path: String) throws {
      try budget.spend(path.utf8.count + MemoryLayout<USDPrim>.size)
      indices[path] = entries.count
      entries.append((path, prim))
      for child in prim.children { try add(child, at: "\(path)/\(child.name)") }
    }
    for prim in stage.prims { try add(prim, at: "/\(prim.name)") }
  }

  subscript(path: String) -> USDPrim? { indices[path].map { entries[$0].prim } }

  /// The prim whose property a path names.
  func owner(of property: String) -> USDPrim? {
    USDPath.property(property).flatMap { self[$0.prim] }
  }
}
