/// The rules for meshes and their materials, and what the meshes consist of.
struct MeshRules {
  private let prims: PrimTable
  private(set) var findings: [String] = []
  private(set) var triangles = 0
  /// Inputs of materials with a texture.
  private(set) var maps: Set<String> = []
  /// Paths of textures.
  private(set) var textures: Set<String> = []

  init(_ prims: PrimTable) {
    self.prims = prims
    for (path, prim) in prims.entries where prim.typeName == "Mesh" {
      checkGeometry(prim, path)
      checkMaterials(of: prim, path)
    }
    for (path, prim) in prims.entries
    where !prim.targets("material:binding").isEmpty
      && !prim.apiSchemas.contains("MaterialBindingAPI")
    {
      findings.append("\(path) has a material without the schema MaterialBindingAPI")
    }
  }

  private mutating func checkGeometry(_ mesh: USDPrim, _ path: String) {
    guard case .intArray(let counts) = mesh.value("faceVertexCounts"),
      case .intArray(let indices) = mesh.value("faceVertexIndices"),
      case .float3Array(let points) = mesh.value("points")
    else {
      findings.append("\(path) has no faces")
      return
    }
    triangles += counts.count
    if counts.contains(where: { $0 != 3 }) {
      findings.append("\(path) has faces that are not triangles")
    }
    if indices.contains(where: { !points.indices.contains(Int($0)) }) {
      findings.append("\(path) has faces of points that do not exist")
    }
    if counts.reduce(0, { $0 + Int($1) }) != indices.count {
      findings.append("\(path) has \(indices.count) corners, which its faces do not add up to")
    }
    if mesh.value("subdivisionScheme")?.text != "none" {
      findings.append("\(path) has a subdivision scheme")
    }
    if mesh.value("normals") == nil, mesh.value("primvars:normals") == nil {
      findings.append("\(path) has no normals")
    }
    if mesh.value("primvars:st") == nil { findings.append("\(path) has no texture coordinates") }
    checkExtent(mesh, path, points)
  }

  private mutating func checkExtent(_ mesh: USDPrim, _ path: String, _ points: [SIMD3<Float>]) {
    guard case .float3Array(let extent) = mesh.value("extent"), extent.count == 2 else {
      findings.append("\(path) has no extent")
      return
    }
    let isInside = points.allSatisfy { point in
      (0..<3).allSatisfy { point[$0] >= extent[0][$0] && point[$0] <= extent[1][$0] }
    }
    if !isInside { findings.append("\(path) has points outside of its extent") }
  }

  private mutating func checkMaterials(of mesh: USDPrim, _ path: String) {
    let subsets = mesh.children.filter { $0.typeName == "GeomSubset" }
    let bindings = ([mesh] + subsets).flatMap { $0.targets("material:binding") }
    guard !bindings.isEmpty else {
      findings.append("\(path) has no material")
      return
    }
    for binding in bindings {
      guard let material = prims[binding], material.typeName == "Material" else {
        findings.append("\(path) has the material \(binding), which does not exist")
        continue
      }
      guard let output = material.targets("outputs:surface").first,
        let surface = prims.owner(of: output)
      else {
        findings.append("\(binding) has no surface")
        continue
      }
      for property in surface.properties where property.name.hasPrefix("inputs:") {
        guard let source = property.targets.first,
          case .asset(let file)? = prims.owner(of: source)?.value("inputs:file")
        else { continue }
        maps.insert(String(property.name.dropFirst("inputs:".count)))
        textures.insert(file)
      }
    }
  }
}
