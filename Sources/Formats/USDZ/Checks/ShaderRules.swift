/// The rules for materials and their shaders.
struct ShaderRules {
  /// The types of the inputs by shader (UsdPreviewSurface specification 2.6).
  private static let inputs: [String: [String: String]] = [
    "UsdPreviewSurface": [
      "diffuseColor": "color3f", "emissiveColor": "color3f", "normal": "normal3f",
      "occlusion": "float", "roughness": "float", "metallic": "float", "displacement": "float",
      "opacity": "float", "opacityMode": "token", "opacityThreshold": "float",
      "clearcoat": "float", "clearcoatRoughness": "float", "ior": "float",
      "useSpecularWorkflow": "int", "specularColor": "color3f",
    ],
    "UsdUVTexture": [
      "file": "asset", "st": "float2", "wrapS": "token", "wrapT": "token", "fallback": "float4",
      "scale": "float4", "bias": "float4", "sourceColorSpace": "token",
    ],
    "UsdPrimvarReader_float2": ["varname": "string", "fallback": "float2"],
    "UsdTransform2d": [
      "in": "float2", "rotation": "float", "scale": "float2", "translation": "float2",
    ],
  ]
  /// Prims that ARKit displays (OpenUSD, `ARKitPrimTypeChecker`).
  private static let types: Set = [
    "", "Scope", "Xform", "Camera", "Shader", "Material", "Mesh", "Sphere", "Cube", "Cylinder",
    "Cone", "Capsule", "GeomSubset", "Points", "SkelRoot", "Skeleton", "SkelAnimation",
    "BlendShape", "SpatialAudio", "PhysicsScene", "Preliminary_ReferenceImage",
    "Preliminary_Text", "Preliminary_Trigger",
  ]

  private(set) var findings: [String] = []

  init(_ prims: PrimTable) {
    for (path, prim) in prims.entries {
      if !Self.types.contains(prim.typeName), !prim.typeName.hasPrefix("RealityKit") {
        findings.append("\(path) is a \(prim.typeName), which ARKit does not display")
      }
      if prim.typeName == "Shader" { checkShader(prim, path, prims) }
    }
  }

  private mutating func checkShader(_ prim: USDPrim, _ path: String, _ prims: PrimTable) {
    let kind = prim.value("info:id")?.text ?? ""
    guard let types = Self.inputs[kind] else {
      if !kind.hasPrefix("UsdPrimvarReader_") {
        findings.append("\(path) is a shader of the kind '\(kind)', which ARKit does not know")
      }
      return
    }
    for property in prim.properties where property.name.hasPrefix("inputs:") {
      let name = String(property.name.dropFirst("inputs:".count))
      guard case .attribute(let type, _, _) = property.content else { continue }
      if let wanted = types[name] {
        if type != wanted { findings.append("\(name) of \(path) is \(type), not \(wanted)") }
      } else {
        findings.append("\(name) of \(path) is no input of \(kind)")
      }
      for source in property.targets where prims.owner(of: source) == nil {
        findings.append("\(name) of \(path) is connected to \(source), which does not exist")
      }
    }
    if kind == "UsdPreviewSurface" { checkNormalMap(of: prim, prims) }
  }

  /// Normals in 8-bit images are stored as (n + 1) / 2 (OpenUSD, `NormalMapTextureChecker`).
  private mutating func checkNormalMap(of surface: USDPrim, _ prims: PrimTable) {
    guard let source = surface.targets("inputs:normal").first,
      let texture = prims.owner(of: source), texture.value("info:id")?.text == "UsdUVTexture"
    else { return }
    if texture.value("inputs:sourceColorSpace")?.text != "raw" {
      findings.append("the normal map's sourceColorSpace is not raw")
    }
    let scale = texture.value("inputs:scale")?.vector ?? []
    let bias = texture.value("inputs:bias")?.vector ?? []
    if Array(scale.prefix(3)) != [2, 2, 2] || Array(bias.prefix(3)) != [-1, -1, -1] {
      findings.append("the normal map's scale and bias are not 2 and -1")
    }
  }
}
