import SceneModel

/// Describes a model with the layout of Object Capture's files: a root with a scope of materials
/// and one of meshes. Each part of the model has a material and a mesh, both named `g0`, `g1` …
package struct USDModelLayer {
  /// The folder of the texture images relative to the layer, with a trailing slash unless empty.
  package var textureFolder: String

  package init(textureFolder: String = "0/") { self.textureFolder = textureFolder }

  /// The layer of `model`.
  package func layer(_ model: ModelContent) -> USDLayer {
    var root = USDPrim("Xform", ModelContent.name)
    root.metadata = [
      USDField("assetInfo", .dictionary([USDField("name", .string(ModelContent.name))])),
      USDField("kind", .token("component")),
    ]
    var materials = USDPrim("Scope", "Materials")
    var geometry = USDPrim("Scope", "Geom")
    for (index, part) in model.parts.enumerated() {
      materials.children.append(material(index, model.textures(ofPart: index)))
      geometry.children.append(Self.mesh(index, part))
    }
    root.children = [materials, geometry]
    return USDLayer(
      metadata: [
        USDField("customLayerData", .dictionary([USDField("creator", .string(model.creator))])),
        USDField("metersPerUnit", .double(1)), USDField("upAxis", .token("Y")),
      ], defaultPrim: ModelContent.name, prims: [root])
  }

  private static func mesh(_ index: Int, _ part: MeshPart) -> USDPrim {
    var mesh = USDPrim("Mesh", ModelContent.partName(index))
    mesh.apiSchemas = ["MaterialBindingAPI"]
    let bounds = Mesh(positions: part.positions).bounds ?? (.zero, .zero)
    mesh.properties = [
      .attribute("float3[]", "extent", .float3Array([bounds.min, bounds.max])),
      .attribute(
        "int[]", "faceVertexCounts",
        .intArray(
          [Int32](repeating: 4, count: part.quadCount)
            + [Int32](repeating: 3, count: part.triangles.count - 2 * part.quadCount))),
      .attribute(
        "int[]", "faceVertexIndices", .intArray(indices(part.triangles, quads: part.quadCount))),
      .relationship("material:binding", [materialPath(index)]),
    ]
    if part.normals.count == part.positions.count {
      mesh.properties.append(
        .attribute(
          "normal3f[]", "normals", .float3Array(part.normals),
          metadata: [USDField("interpolation", .token("vertex"))]))
    }
    mesh.properties.append(.attribute("point3f[]", "points", .float3Array(part.positions)))
    if !part.textureTriangles.isEmpty {
      mesh.properties += [
        .attribute(
          "texCoord2f[]", "primvars:st", .float2Array(part.textureCoordinates),
          metadata: [USDField("interpolation", .token("faceVarying"))]),
        .attribute(
          "int[]", "primvars:st:indices",
          .intArray(indices(part.textureTriangles, quads: part.quadCount))),
      ]
    }
    mesh.properties.append(
      .attribute("token", "subdivisionScheme", .token("none"), isUniform: true))
    return mesh
  }

  /// The path of the material of part `index`.
  private static func materialPath(_ index: Int) -> String {
    "/\(ModelContent.name)/Materials/\(ModelContent.partName(index))"
  }

  /// The face corner indices; quads, of two triangles each, come first.
  private static func indices(_ triangles: [Triangle], quads: Int) -> [Int32] {
    let corners = stride(from: 0, to: 2 * quads, by: 2).flatMap {
      triangles[$0].quad(with: triangles[$0 + 1]).map(Int32.init(bitPattern:))
    }
    return corners
      + triangles[(2 * quads)...].flatMap {
        [Int32(bitPattern: $0.a), Int32(bitPattern: $0.b), Int32(bitPattern: $0.c)]
      }
  }
}

// MARK: - Materials

extension USDModelLayer {
  private func material(_ index: Int, _ textures: [EncodedTexture]) -> USDPrim {
    let path = Self.materialPath(index)
    var material = USDPrim("Material", ModelContent.partName(index))
    material.properties = [
      .attribute("string", "inputs:frame:stPrimvarName", .string("st")),
      .connection("token", "outputs:surface", to: "\(path)/surfaceShader.outputs:surface"),
    ]
    var reader = Self.shader("uvReader_st", "UsdPrimvarReader_float2")
    reader.properties += [
      .connection("string", "inputs:varname", to: "\(path).inputs:frame:stPrimvarName"),
      .attribute("float2", "outputs:result"),
    ]
    material.children = [surface(path, textures), reader]
    material.children += textures.map { texture(path, $0, atlas: index) }
    return material
  }

  private func surface(_ path: String, _ textures: [EncodedTexture]) -> USDPrim {
    var shader = Self.shader("surfaceShader", "UsdPreviewSurface")
    for texture in textures {
      let input = Self.input(of: texture.map)
      shader.properties.append(
        .connection(
          input.typeName, "inputs:\(input.name)",
          to: "\(path)/\(input.name)_texture.outputs:\(input.channels)"))
    }
    if !textures.contains(where: { $0.map == .roughness }) {
      shader.properties.append(
        .attribute("float", "inputs:roughness", .float(Float(ModelContent.defaultRoughness))))
    }
    shader.properties.append(.attribute("token", "outputs:surface"))
    return shader
  }

  private func texture(_ path: String, _ texture: EncodedTexture, atlas: Int) -> USDPrim {
    let input = Self.input(of: texture.map)
    var shader = Self.shader("\(input.name)_texture", "UsdUVTexture")
    let file = textureFolder + texture.fileName(atlas: atlas)
    if texture.map == .normal {
      shader.properties.append(
        .attribute("float4", "inputs:bias", .float4([-1, -1, -1, -1])))
    }
    shader.properties.append(.attribute("asset", "inputs:file", .asset(file)))
    if texture.map == .normal {
      shader.properties.append(.attribute("float4", "inputs:scale", .float4([2, 2, 2, 2])))
    }
    shader.properties += [
      .attribute(
        "token", "inputs:sourceColorSpace", .token(texture.map == .diffuseColor ? "sRGB" : "raw")),
      .connection("float2", "inputs:st", to: "\(path)/uvReader_st.outputs:result"),
      .attribute("token", "inputs:wrapS", .token("clamp")),
      .attribute("token", "inputs:wrapT", .token("clamp")),
      .attribute(input.channels == "rgb" ? "float3" : "float", "outputs:\(input.channels)"),
    ]
    return shader
  }

  private static func shader(_ name: String, _ identifier: String) -> USDPrim {
    var shader = USDPrim("Shader", name)
    shader.properties = [.attribute("token", "info:id", .token(identifier), isUniform: true)]
    return shader
  }

  /// The UsdPreviewSurface input for a map.
  private static func input(
    of map: TextureMap
  ) -> (name: String, typeName: String, channels: String) {
    switch map {
    case .diffuseColor: ("diffuseColor", "color3f", "rgb")
    case .normal: ("normal", "normal3f", "rgb")
    case .ambientOcclusion: ("occlusion", "float", "r")
    case .roughness: ("roughness", "float", "r")
    case .displacement: ("displacement", "float", "r")
    }
  }
}
