import SceneModel

/// The meshes of a stage as a model.
enum USDScene {
  /// The visible meshes of `stage`, in meters with y up. `contents` has the bytes of a file; nil
  /// without it. Throws a `FormatFault`, or what `contents` throws.
  static func model(
    of stage: USDStage, budget: MemoryBudget, contents: (String) throws -> [UInt8]?
  ) throws -> LoadedModel {
    var collector = MeshCollector(
      materials: try USDMaterials(stage, budget: budget), budget: budget)
    var root = NodeTransform.scale(SIMD3(repeating: stage.metersPerUnit))
    if stage.isZUp {
      root = root * NodeTransform(linear: Matrix3(rows: [1, 0, 0], [0, 0, 1], [0, -1, 0]))
    }
    let context = MeshCollector.Context(root: root, parent: root, material: nil)
    for prim in stage.prims { try collector.visit(prim, context, contents) }
    return LoadedModel(
      parts: collector.parts, missingFiles: stage.missingFiles + collector.missingFiles)
  }
}

/// Collects the meshes below prims.
private struct MeshCollector {
  /// What a prim inherits.
  struct Context {
    /// `worldFromStage`.
    var root: NodeTransform
    /// `worldFromParent`.
    var parent: NodeTransform
    /// The path of the bound material.
    var material: String?
  }

  /// Prims whose children aren't part of the scene as such.
  private static let skippedTypes: Set = ["Material", "PointInstancer", "SkelAnimation"]

  let materials: USDMaterials
  let budget: MemoryBudget
  private(set) var parts: [LoadedModel.Part] = []
  private(set) var missingFiles: [String] = []
  private var images: [String: EncodedImage?] = [:]

  init(materials: USDMaterials, budget: MemoryBudget) {
    (self.materials, self.budget) = (materials, budget)
  }

  /// Adds the meshes of a prim and its children. The depth of prims is limited by the readers of
  /// layers, and by that of references.
  mutating func visit(
    _ prim: USDPrim, _ context: Context, _ contents: (String) throws -> [UInt8]?
  ) throws {
    guard prim.specifier == .def, prim.metadata("active") != .bool(false),
      prim.value("visibility")?.text != "invisible",
      !["guide", "proxy"].contains(prim.value("purpose")?.text),
      !Self.skippedTypes.contains(prim.typeName)
    else { return }
    var context = context
    let transform = prim.transform
    context.parent = (transform.isReset ? context.root : context.parent) * transform.map
    context.material = Self.material(of: prim) ?? context.material
    if prim.typeName == "Mesh", let mesh = try USDMesh(prim, budget: budget) {
      for (material, faces) in Self.faces(of: mesh, prim, context.material) {
        let appearance = materials.appearance(material)
        var part = try mesh.part(faces: faces, appearance, budget: budget)
        try budget.spend(part.positions.count, of: MemoryLayout<SIMD3<Float>>.stride)
        part = context.parent.applied(to: part)
        if let texture = appearance.texture { part.baseColor = try image(texture, contents) }
        parts.append(part)
      }
    }
    for child in prim.children { try visit(child, context, contents) }
  }

  private static func material(of prim: USDPrim) -> String? {
    (prim.targets("material:binding").first ?? prim.targets("material:binding:preview").first)
      ?? prim.targets("material:binding:full").first
  }

  /// The faces by material: those of subsets with a material, then the others.
  private static func faces(
    of mesh: USDMesh, _ prim: USDPrim, _ material: String?
  ) -> [(material: String?, faces: [Int])] {
    var isAssigned = [Bool](repeating: false, count: mesh.counts.count)
    var result: [(material: String?, faces: [Int])] = []
    for subset in prim.children where subset.typeName == "GeomSubset" {
      guard let material = self.material(of: subset),
        case .intArray(let list) = subset.value("indices"),
        ["face", nil].contains(subset.value("elementType")?.text)
      else { continue }
      var faces: [Int] = []
      for face in list where isAssigned.indices.contains(Int(face)) && !isAssigned[Int(face)] {
        isAssigned[Int(face)] = true
        faces.append(Int(face))
      }
      if !faces.isEmpty { result.append((material, faces)) }
    }
    let rest = isAssigned.indices.filter { !isAssigned[$0] }
    return rest.isEmpty ? result : result + [(material, rest)]
  }

  /// The image of a file; nil if it is missing.
  private mutating func image(
    _ file: String, _ contents: (String) throws -> [UInt8]?
  ) throws -> EncodedImage? {
    if let image = images[file] { return image }
    let bytes = try contents(file)
    try budget.spend(bytes?.count ?? 0)
    let image = bytes.flatMap { EncodedImage(recognizing: $0) }
    images[file] = .some(image)
    if image == nil { missingFiles.append(file) }
    return image
  }
}
