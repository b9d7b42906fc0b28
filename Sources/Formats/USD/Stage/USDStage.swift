/// The prims of a layer and of the layers that it refers to.
struct USDStage {
  /// The root prims. Paths of prims and properties are absolute, and those of files relative to the
  /// folder of the model.
  var prims: [USDPrim]
  /// Whether z is up; otherwise y is.
  var isZUp: Bool
  var metersPerUnit: Double
  /// Layers that are missing.
  var missingFiles: [String]
}

extension USDStage {
  /// Composes the layer in the file `file`. `contents` has the bytes of a file; nil without it.
  ///
  /// Of composition, there are sublayers, references, payloads and inherits; weaker ones fill in
  /// what stronger ones don't define. Throws a `FormatFault`, an `UnsupportedFeature`, or
  /// `ByteCursor.Truncated`.
  init(
    _ file: String, budget: MemoryBudget, contents: @escaping (String) throws -> [UInt8]?
  ) throws {
    var composer = Composer(budget: budget, contents: contents)
    guard let layer = try composer.layer(file) else { throw FormatFault("it has no layer") }
    prims = try composer.prims(of: file, depth: 0)
    isZUp = layer.metadata("upAxis")?.text?.uppercased() == "Z"
    // USD's default is centimeters.
    let unit = layer.metadata("metersPerUnit")?.number ?? 0.01
    metersPerUnit = unit.isFinite && unit > 0 ? unit : 0.01
    missingFiles = composer.missingFiles
  }
}

/// Loads layers, and merges prims with those that they refer to.
private struct Composer {
  /// Layers that refer to each other in a row. Chosen.
  private static let maximumDepth = 16
  /// Nesting of prims after composition. Chosen: as in one layer.
  private static let maximumNesting = 128

  let budget: MemoryBudget
  let contents: (String) throws -> [UInt8]?
  private var layers: [String: USDLayer?] = [:]
  /// The prims of layers with references to them, by path.
  private var indices: [String: [String: USDPrim]] = [:]
  private(set) var missingFiles: [String] = []
  private var nesting = 0

  init(budget: MemoryBudget, contents: @escaping (String) throws -> [UInt8]?) {
    (self.budget, self.contents) = (budget, contents)
  }

  /// The layer of a file; nil if it is missing.
  mutating func layer(_ file: String) throws -> USDLayer? {
    if let layer = layers[file] { return layer }
    let layer = try contents(file).map {
      try budget.spend($0.count)
      return try USDLayer($0, budget: budget)
    }
    layers[file] = .some(layer)
    if layer == nil { missingFiles.append(file) }
    return layer
  }

  /// The root prims of a layer, composed.
  mutating func prims(of file: String, depth: Int) throws -> [USDPrim] {
    try checkDepth(depth)
    guard let layer = try layer(file) else { return [] }
    var result = try layer.prims.map {
      try composed($0, at: "/\($0.name)", in: file, depth: depth)
    }
    guard case .tokenArray(let weaker) = layer.metadata("subLayers") else { return result }
    for name in weaker {
      let path = USDPath.file(name, from: USDPath.folder(of: file))
      result = Self.merged(result, over: try prims(of: path, depth: depth + 1))
    }
    return result
  }

  private func checkDepth(_ depth: Int) throws {
    guard depth < Self.maximumDepth else {
      throw FormatFault("its references are nested too deeply, or form a circle")
    }
  }

  /// The prim at `path` of a layer with everything that it and its children refer to.
  private mutating func composed(
    _ prim: USDPrim, at path: String, in file: String, depth: Int
  ) throws -> USDPrim {
    nesting += 1
    defer { nesting -= 1 }
    guard nesting <= Self.maximumNesting else {
      throw FormatFault("its prims are nested too deeply")
    }
    try budget.spend(
      path.utf8.count + MemoryLayout<USDPrim>.size + prim.properties.count
        * MemoryLayout<USDProperty>.stride)
    var result = prim
    let folder = USDPath.folder(of: file)
    result.properties = prim.properties.map {
      $0.mapped(
        target: { USDPath.absolute($0, from: path) }, file: { USDPath.file($0, from: folder) })
    }
    result.children = try prim.children.map {
      try composed($0, at: "\(path)/\($0.name)", in: file, depth: depth)
    }
    for name in ["inheritPaths", "inherits", "references", "payload"] {
      guard case .references(let references) = prim.metadata(name) else { continue }
      for reference in references {
        let weaker = try target(of: reference, for: path, in: file, depth: depth + 1)
        if let weaker { result = Self.merged(result, over: weaker) }
      }
    }
    return result
  }

  /// The prim that a reference of the prim at `path` refers to, as if it were there.
  private mutating func target(
    of reference: USDReference, for path: String, in file: String, depth: Int
  ) throws -> USDPrim? {
    try checkDepth(depth)
    let folder = USDPath.folder(of: file)
    let other =
      reference.asset.isEmpty ? file : USDPath.file(reference.asset, from: folder)
    guard let layer = try layer(other) else { return nil }
    let source =
      reference.path.isEmpty
      ? "/" + (layer.defaultPrim.isEmpty ? layer.prims.first?.name ?? "" : layer.defaultPrim)
      : reference.path
    guard let prim = try prim(at: source, of: layer, in: other) else { return nil }
    return try composed(prim, at: source, in: other, depth: depth)
      .mapped { USDPath.moved($0, from: source, to: path) }
  }

  private mutating func prim(
    at path: String, of layer: USDLayer, in file: String
  ) throws -> USDPrim? {
    if let index = indices[file] { return index[path] }
    var index: [String: USDPrim] = [:]
    func add(_ prim: USDPrim, at path: String) throws {
      try budget.spend(path.utf8.count + MemoryLayout<USDPrim>.size)
      index[path] = prim
      for child in prim.children { try add(child, at: "\(path)/\(child.name)") }
    }
    for prim in layer.prims { try add(prim, at: "/\(prim.name)") }
    indices[file] = index
    return index[path]
  }

  // MARK: Merging

  private static func merged(_ strong: [USDPrim], over weak: [USDPrim]) -> [USDPrim] {
    var result = strong
    let indices = Dictionary(
      strong.enumerated().map { ($1.name, $0) }, uniquingKeysWith: { first, _ in first })
    for prim in weak {
      if let index = indices[prim.name] {
        result[index] = merged(result[index], over: prim)
      } else {
        result.append(prim)
      }
    }
    return result
  }

  private static func merged(_ strong: USDPrim, over weak: USDPrim) -> USDPrim {
    var result = strong
    if result.typeName.isEmpty { result.typeName = weak.typeName }
    // A class stays abstract where it is, but not where it is included.
    if result.specifier == .over, weak.specifier == .def { result.specifier = .def }
    let fields = Set(strong.metadata.map(\.name))
    result.metadata += weak.metadata.filter { !fields.contains($0.name) }
    let indices = Dictionary(
      strong.properties.enumerated().map { ($1.name, $0) }, uniquingKeysWith: { first, _ in first })
    for property in weak.properties {
      if let index = indices[property.name] {
        if !result.properties[index].hasContent { result.properties[index] = property }
      } else {
        result.properties.append(property)
      }
    }
    result.children = merged(strong.children, over: weak.children)
    return result
  }
}
