import SceneModel

/// Builds the glTF description of a model and the binary data that it refers to.
struct GLTFBuilder {
  /// The buffer of all buffer views; each starts at a multiple of four bytes.
  private(set) var binary = ByteWriter()
  private var primitives: [GLTFDocument.Primitive] = []
  private var materials: [GLTFDocument.Material] = []
  private var images: [GLTFDocument.Image] = []
  private var accessors: [GLTFDocument.Accessor] = []
  private var views: [GLTFDocument.BufferView] = []

  /// The description of all appended parts: one scene with one node and one mesh.
  func document(name: String, generator: String) -> GLTFDocument {
    var document = GLTFDocument(asset: .init(generator: generator))
    guard !primitives.isEmpty else { return document }
    document.scenes = [.init(nodes: [0])]
    document.nodes = [.init(name: name, mesh: 0)]
    document.meshes = [.init(name: name, primitives: primitives)]
    document.materials = materials
    if !images.isEmpty {
      document.textures = images.indices.map { .init(source: $0) }
      document.images = images
      document.samplers = [.init()]
    }
    document.accessors = accessors
    document.bufferViews = views
    document.buffers = [.init(byteLength: binary.count)]
    return document
  }

  /// Adds a part of the mesh with its material.
  mutating func append(
    _ primitive: IndexedTriangles, of mesh: TexturedMesh, _ material: GLTFMaterial
  ) {
    let normals = mesh.mesh.normals
    let hasNormals = normals.count == mesh.mesh.positions.count
    let position = append(positions: primitive.positions.map { mesh.mesh.positions[Int($0)] })
    let normal = hasNormals ? append(normals: primitive.positions.map { normals[Int($0)] }) : nil
    let coordinates = primitive.coordinates.map { mesh.textureCoordinates[Int($0)] }
    let coordinate = coordinates.isEmpty ? nil : append(textureCoordinates: coordinates)
    primitives.append(
      .init(
        attributes: .init(
          position: position, normal: normal, textureCoordinate: coordinate),
        indices: append(indices: primitive.indices), material: materials.count))
    append(coordinates.isEmpty ? GLTFMaterial() : material)
  }
}

// MARK: - Material

extension GLTFBuilder {
  private mutating func append(_ material: GLTFMaterial) {
    var result = GLTFDocument.Material(
      name: ModelContent.partName(materials.count),
      pbrMetallicRoughness: .init(roughnessFactor: ModelContent.defaultRoughness))
    result.pbrMetallicRoughness.baseColorTexture = material.baseColor.map { append($0) }
    result.normalTexture = material.normal.map { append($0) }
    switch material.surface {
    case .occlusion(let image):
      result.occlusionTexture = append(image)
    case .roughness(let image):
      setRoughness(append(image), of: &result)
    case .occlusionAndRoughness(let image):
      let texture = append(image)
      result.occlusionTexture = texture
      setRoughness(texture, of: &result)
    case nil: break
    }
    materials.append(result)
  }

  private func setRoughness(
    _ texture: GLTFDocument.TextureReference, of material: inout GLTFDocument.Material
  ) {
    material.pbrMetallicRoughness.metallicRoughnessTexture = texture
    material.pbrMetallicRoughness.roughnessFactor = 1
  }

  private mutating func append(_ image: EncodedImage) -> GLTFDocument.TextureReference {
    let view = append(nil) { $0.append(contentsOf: image.bytes) }
    images.append(.init(bufferView: view, mimeType: image.mediaType))
    return .init(index: images.count - 1)
  }
}

// MARK: - Accessors

extension GLTFBuilder {
  private mutating func append(positions: [SIMD3<Float>]) -> Int {
    let view = append(.vertices) { writer in positions.forEach { writer.append($0) } }
    let bounds = SceneModel.Mesh(positions: positions).bounds ?? (.zero, .zero)
    // As doubles, which JSON represents exactly: validators compare them with the data.
    func exact(_ v: SIMD3<Float>) -> [Double] { [Double(v.x), Double(v.y), Double(v.z)] }
    accessors.append(
      .init(
        bufferView: view, componentType: .float, count: positions.count, type: "VEC3",
        min: exact(bounds.min), max: exact(bounds.max)))
    return accessors.count - 1
  }

  private mutating func append(normals: [SIMD3<Float>]) -> Int {
    let view = append(.vertices) { writer in
      for normal in normals {
        // glTF requires unit length, even for vertices without a normal.
        let unit = normal.normalized
        writer.append(unit.squaredLength > 0.5 ? unit : [0, 1, 0])
      }
    }
    accessors.append(
      .init(bufferView: view, componentType: .float, count: normals.count, type: "VEC3"))
    return accessors.count - 1
  }

  private mutating func append(textureCoordinates: [SIMD2<Float>]) -> Int {
    let view = append(.vertices) { writer in
      // In glTF, (0, 0) is the top left.
      for st in textureCoordinates { writer.append(SIMD2(st.x, 1 - st.y)) }
    }
    accessors.append(
      .init(
        bufferView: view, componentType: .float, count: textureCoordinates.count, type: "VEC2"))
    return accessors.count - 1
  }

  private mutating func append(indices: [UInt32]) -> Int {
    let view = append(.indices) { writer in indices.forEach { writer.append($0) } }
    accessors.append(
      .init(bufferView: view, componentType: .unsignedInt, count: indices.count, type: "SCALAR"))
    return accessors.count - 1
  }

  /// Adds a buffer view with the data that `body` writes, and returns its index.
  private mutating func append(
    _ target: GLTFDocument.BufferView.Target?, _ body: (inout ByteWriter) -> Void
  ) -> Int {
    let start = binary.count
    body(&binary)
    views.append(.init(byteOffset: start, byteLength: binary.count - start, target: target))
    binary.align(to: 4)
    return views.count - 1
  }
}
