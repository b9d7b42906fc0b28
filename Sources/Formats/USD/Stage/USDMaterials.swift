import Foundation
import SceneModel

/// The base colors of the materials of a stage.
struct USDMaterials {
  /// What a material means for the base color.
  struct Appearance: Equatable {
    /// The file of the texture.
    var texture: String?
    /// Linear; multiplies the texture or the vertex colors.
    var factor = SIMD3<Float>(1, 1, 1)
    var usesVertexColors = true
    /// The primvar with the texture coordinates.
    var coordinates = "st"
    /// `textureFromPrimvar`, for texture coordinates.
    var transform = TextureTransform.identity
  }

  /// UsdPreviewSurface's color without a value. Limit: of the specification.
  private static let defaultColor = SIMD3<Float>(0.18, 0.18, 0.18)
  /// Connections are followed so far. Chosen.
  private static let maximumHops = 16
  /// The names of the base color in UsdPreviewSurface, and in surfaces of MaterialX.
  private static let colorInputs = ["inputs:diffuseColor", "inputs:base_color", "inputs:baseColor"]

  /// The materials and everything in them, by path.
  private let prims: [String: USDPrim]

  /// Throws a `FormatFault`.
  init(_ stage: USDStage, budget: MemoryBudget) throws {
    var prims: [String: USDPrim] = [:]
    func add(_ prim: USDPrim, at path: String, isInMaterial: Bool) throws {
      try budget.spend(path.utf8.count)
      let isInMaterial = isInMaterial || prim.typeName == "Material"
      if isInMaterial || prim.typeName == "Shader" || prim.typeName == "NodeGraph" {
        prims[path] = prim
      }
      for child in prim.children {
        try add(child, at: "\(path)/\(child.name)", isInMaterial: isInMaterial)
      }
    }
    for prim in stage.prims { try add(prim, at: "/\(prim.name)", isInMaterial: false) }
    self.prims = prims
  }

  /// The appearance with the material at `path`; without one, that of the vertex colors.
  func appearance(_ path: String?) -> Appearance {
    var result = Appearance()
    guard let path, let material = prims[path] else { return result }
    let surface = material.properties.first {
      $0.name == "outputs:surface" || $0.name.hasSuffix(":surface") && !$0.targets.isEmpty
    }
    guard let output = surface?.targets.first, let shader = source(of: output)?.prim,
      let input = Self.colorInputs.lazy.compactMap({ shader.property($0) }).first
    else {
      result.factor = Self.defaultColor
      return result
    }
    let origin = input.targets.first.flatMap { source(of: $0) }
    if let reader = origin?.prim, let file = value("inputs:file", of: reader),
      case .asset(let path) = file
    {
      result.texture = path
      setCoordinates(of: reader, &result)
      if let scale = value("inputs:scale", of: reader)?.vector, scale.count >= 3 {
        result.factor = SIMD3(Float(scale[0]), Float(scale[1]), Float(scale[2]))
      }
      return result
    }
    if origin?.prim.value("info:id")?.text?.hasPrefix("UsdPrimvarReader") == true { return result }
    result.usesVertexColors = false
    let color = (origin?.value ?? input.value)?.vector ?? []
    result.factor =
      color.count >= 3
      ? SIMD3(Float(color[0]), Float(color[1]), Float(color[2])) : Self.defaultColor
    return result
  }

  /// Follows the texture coordinates of a UsdUVTexture, through a UsdTransform2d if there is one,
  /// to the reader of a primvar.
  private func setCoordinates(of texture: USDPrim, _ appearance: inout Appearance) {
    var next = texture.targets("inputs:st").first.flatMap { source(of: $0)?.prim }
    if let map = next, map.value("info:id")?.text == "UsdTransform2d" {
      let scale = value("inputs:scale", of: map)?.vector ?? [1, 1]
      let translation = value("inputs:translation", of: map)?.vector ?? [0, 0]
      let degrees = value("inputs:rotation", of: map)?.number ?? 0
      appearance.transform = TextureTransform(
        scale: [Float(scale[0]), Float(scale[1])], angle: Float(degrees * .pi / 180),
        offset: [Float(translation[0]), Float(translation[1])])
      next = map.targets("inputs:in").first.flatMap { source(of: $0)?.prim }
    }
    if let reader = next, let name = value("inputs:varname", of: reader)?.text {
      appearance.coordinates = name
    }
  }

  /// The value of an input, which may be connected to one elsewhere.
  private func value(_ name: String, of prim: USDPrim) -> USDValue? {
    guard let property = prim.property(name) else { return nil }
    return property.targets.first.flatMap { source(of: $0)?.value } ?? property.value
  }

  /// The prim and the value at the end of the connections from the attribute at `path`.
  private func source(of path: String) -> (prim: USDPrim, value: USDValue?)? {
    var path = path
    for _ in 0..<Self.maximumHops {
      guard let (owner, name) = USDPath.property(path), let prim = prims[owner] else { return nil }
      guard let next = prim.targets(name).first else { return (prim, prim.value(name)) }
      path = next
    }
    return nil
  }
}
