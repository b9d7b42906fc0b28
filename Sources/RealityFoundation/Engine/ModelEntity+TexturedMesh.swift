import SceneModel

extension ModelEntity {
  /// A model as an entity: one shape, with a part and a material for each texture.
  convenience init(_ model: TexturedMesh) {
    let ranges =
      model.atlases.isEmpty ? [0..<model.mesh.triangles.count] : model.atlases.map(\.triangles)
    let parts = ranges.enumerated().map { MeshResource.Part($0, model, triangles: $1) }
    let shape = MeshResource.Model(id: Self.shapeName, parts: MeshPartCollection(parts))
    let instance = MeshResource.Instance(
      id: Self.shapeName, model: Self.shapeName, transform: matrix_identity_float4x4)
    let mesh = MeshResource(
      .init(models: MeshModelCollection([shape]), instances: MeshInstanceCollection([instance])))
    self.init(mesh: mesh, materials: model.atlases.map { PhysicallyBasedMaterial($0.maps) })
    name = Self.shapeName
  }

  /// The name of the model in files.
  private static let shapeName = "baked_mesh"
}

extension MeshResource.Part {
  fileprivate init(_ index: Int, _ model: TexturedMesh, triangles: Range<Int>) {
    let indexed = IndexedTriangles(model, triangles: triangles)
    let mesh = model.mesh
    self.init(
      id: "g\(index)", materialIndex: index,
      positions: MeshBuffer(indexed.positions.map { mesh.positions[Int($0)] }),
      normals: mesh.normals.count == mesh.positions.count
        ? MeshBuffer(indexed.positions.map { mesh.normals[Int($0)] }) : nil,
      textureCoordinates: indexed.coordinates.isEmpty
        ? nil : MeshBuffer(indexed.coordinates.map { model.textureCoordinates[Int($0)] }),
      triangleIndices: MeshBuffer(indexed.indices))
  }
}

extension PhysicallyBasedMaterial {
  /// The maps that a material supports.
  static let maps: Set<TextureMap> = [.diffuseColor, .normal, .roughness, .ambientOcclusion]

  fileprivate init(_ maps: [TextureMap: RasterImage]) {
    func texture(_ map: TextureMap, _ semantic: TextureResource.Semantic) -> Texture? {
      maps[map].map { Texture(TextureResource($0, semantic: semantic)) }
    }
    self.init()
    baseColor.texture = texture(.diffuseColor, .color)
    normal.texture = texture(.normal, .normal)
    roughness.texture = texture(.roughness, .raw)
    // The value in files without a roughness map.
    if roughness.texture == nil { roughness.scale = 0.9 }
    ambientOcclusion.texture = texture(.ambientOcclusion, .raw)
  }
}
