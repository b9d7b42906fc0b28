extension USDCrate {
  /// The layer of a crate file of version 0.4 or later: what `USDValue` can represent; of animated
  /// values, the first sample. `budget` limits the memory of the result.
  ///
  /// Throws a `FormatFault`, an `UnsupportedFeature`, or `ByteCursor.Truncated`.
  static func decode(_ bytes: [UInt8], budget: MemoryBudget) throws -> USDLayer {
    let file = try CrateFile(bytes)
    let tables = try CrateTables(file, budget: budget)
    let values = CrateValueReader(file: file, tables: tables, budget: budget)
    return try CrateLayerReader(tables: tables, values: values, budget: budget).layer()
  }
}

/// Builds the tree of prims from the specs of a crate file.
private struct CrateLayerReader {
  let tables: CrateTables
  let values: CrateValueReader
  let budget: MemoryBudget
  /// For each path, the specs below it.
  private var children: [Int: [CrateTables.Spec]] = [:]

  init(tables: CrateTables, values: CrateValueReader, budget: MemoryBudget) {
    (self.tables, self.values, self.budget) = (tables, values, budget)
    // A second spec for a path could double the tree at every level.
    var isDefined = [Bool](repeating: false, count: tables.paths.nodes.count)
    for spec in tables.specs where !isDefined[spec.path] {
      isDefined[spec.path] = true
      guard let parent = tables.paths.nodes[spec.path].parent else { continue }
      children[parent, default: []].append(spec)
    }
  }

  func layer() throws -> USDLayer {
    guard let root = tables.paths.root else { throw FormatFault("it has no root") }
    var layer = USDLayer(metadata: [], defaultPrim: "", prims: [])
    for spec in tables.specs where spec.type == .pseudoRoot {
      for (name, rep) in try tables.fields(of: spec, budget: budget) {
        guard name != "primChildren", let value = try values.value(rep) else { continue }
        if name == "defaultPrim", case .token(let prim) = value {
          layer.defaultPrim = prim
        } else {
          layer.metadata.append(USDField(name, value))
        }
      }
    }
    for spec in children[root] ?? [] where spec.type == .prim {
      layer.prims.append(try prim(spec))
    }
    return layer
  }

  private func name(of spec: CrateTables.Spec) -> String {
    tables.tokens[tables.paths.nodes[spec.path].token]
  }

  /// The depth of the recursion is that of the paths, which is limited.
  private func prim(_ spec: CrateTables.Spec) throws -> USDPrim {
    var prim = USDPrim("", name(of: spec))
    for (name, rep) in try tables.fields(of: spec, budget: budget) {
      switch (name, try values.value(rep)) {
      case ("properties", _), ("primChildren", _): break
      case ("specifier", .int(let value)):
        prim.specifier = value == 1 ? .over : value == 2 ? .class : .def
      case ("typeName", .token(let type)): prim.typeName = type
      case ("apiSchemas", .tokenArray(let names)): prim.apiSchemas = names
      case ("inheritPaths", _):
        let bases = try values.paths(rep).map { USDReference(asset: "", path: $0) }
        prim.metadata.append(USDField(name, .references(bases)))
      case (_, let value?): prim.metadata.append(USDField(name, value))
      case (_, nil): break
      }
    }
    for child in children[spec.path] ?? [] {
      let isProperty = tables.paths.nodes[child.path].isProperty
      switch child.type {
      case .prim where !isProperty: prim.children.append(try self.prim(child))
      case .attribute where isProperty, .relationship where isProperty:
        prim.properties.append(try property(child))
      default: break
      }
    }
    return prim
  }

  private func property(_ spec: CrateTables.Spec) throws -> USDProperty {
    var (typeName, value) = ("", nil as USDValue?)
    var targets: [String] = []
    var result = USDProperty.relationship(name(of: spec), [])
    result.isUniform = false
    for (name, rep) in try tables.fields(of: spec, budget: budget) {
      switch name {
      case "connectionPaths", "targetPaths": targets = try values.paths(rep)
      case "default": value = try values.value(rep) ?? value
      case "timeSamples": value = try value ?? values.value(rep)
      case "connectionChildren", "targetChildren", "custom": break
      default:
        switch (name, try values.value(rep)) {
        case ("typeName", .token(let name)): typeName = name
        case ("variability", .int(let value)): result.isUniform = value == 1
        case (_, let value?): result.metadata.append(USDField(name, value))
        case (_, nil): break
        }
      }
    }
    result.content =
      spec.type == .attribute
      ? .attribute(typeName: typeName, value: value, connections: targets)
      : .relationship(targets: targets)
    return result
  }
}
