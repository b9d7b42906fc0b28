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
  /// The size of all compressed views after decompression.
  private var decompressedSize = 0

  /// The description of all appended parts: one scene with one node and one mesh. Positions are
  /// coordinates in `grid` if there is one.
  func document(
    name: String, generator: String, grid: PositionGrid? = nil
  ) -> GLTFDocument {
    var document = GLTFDocument(asset: .init(generator: generator))
    guard !primitives.isEmpty else { return document }
    document.scenes = [.init(nodes: [0])]
    document.nodes = [
      .init(
        name: name, mesh: 0, translation: grid.map { Self.exact($0.origin) },
        scale: grid.map { Self.exact(SIMD3(repeating: $0.step)) })
    ]
    document.meshes = [.init(name: name, primitives: primitives)]
    document.materials = materials
    if !images.isEmpty {
      document.textures = images.indices.map(texture)
      document.images = images
      document.samplers = [.init()]
    }
    document.accessors = accessors
    document.bufferViews = views
    document.buffers = [.init(byteLength: binary.count)]
    if decompressedSize > 0 {
      document.buffers?.append(.init(byteLength: decompressedSize, extensions: .init()))
    }
    document.extensionsRequired = extensions
    document.extensionsUsed = extensions
    return document
  }

  /// The extensions that a reader must support; nil without any.
  private var extensions: [GLTFDocument.Extension]? {
    let used: [GLTFDocument.Extension] =
      (decompressedSize > 0 ? [.compression, .quantization] : [])
      + (images.contains(where: \.isWebP) ? [.webP] : [])
    return used.isEmpty ? nil : used
  }

  private func texture(_ index: Int) -> GLTFDocument.Texture {
    images[index].isWebP
      ? .init(extensions: .init(webP: .init(source: index))) : .init(source: index)
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

  /// Adds a part of the mesh with its material, compressed.
  mutating func append(
    _ primitive: QuantizedPrimitive, _ material: GLTFMaterial,
    encodedBy encoder: some GLTFMeshEncoder
  ) throws {
    let position = try append(primitive.positions, nil, primitive.vertexCount, encoder) {
      $0.componentType = .unsignedShort
      $0.min = Self.exact(SIMD3<Float>(primitive.bounds.min))
      $0.max = Self.exact(SIMD3<Float>(primitive.bounds.max))
    }
    let normal = try primitive.normals.map {
      try append($0, .octahedral, primitive.vertexCount, encoder) {
        ($0.componentType, $0.normalized) = (.byte, true)
      }
    }
    let coordinate = try primitive.textureCoordinates.map {
      try append($0, nil, primitive.vertexCount, encoder) {
        ($0.componentType, $0.normalized, $0.type) = (.unsignedShort, true, "VEC2")
      }
    }
    primitives.append(
      .init(
        attributes: .init(position: position, normal: normal, textureCoordinate: coordinate),
        indices: try append(triangles: primitive, encoder), material: materials.count))
    append(coordinate == nil ? GLTFMaterial() : material)
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
  /// As doubles, which JSON represents exactly: validators compare them with the data.
  private static func exact(_ v: SIMD3<Float>) -> [Double] {
    [Double(v.x), Double(v.y), Double(v.z)]
  }

  private mutating func append(positions: [SIMD3<Float>]) -> Int {
    let view = append(.vertices) { writer in positions.forEach { writer.append($0) } }
    let bounds = SceneModel.Mesh(positions: positions).bounds ?? (.zero, .zero)
    accessors.append(
      .init(
        bufferView: view, componentType: .float, count: positions.count, type: "VEC3",
        min: Self.exact(bounds.min), max: Self.exact(bounds.max)))
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

// MARK: - Compression

extension GLTFBuilder {
  /// Adds an accessor of compressed vectors with three components, as changed by `describe`.
  private mutating func append(
    _ attribute: QuantizedPrimitive.Attribute, _ filter: GLTFDocument.CompressedView.Filter?,
    _ count: Int, _ encoder: some GLTFMeshEncoder,
    _ describe: (inout GLTFDocument.Accessor) -> Void
  ) throws -> Int {
    let view = appendCompressed(
      try encoder.encode(vertices: attribute.bytes, stride: attribute.stride), .attributes,
      count: count, stride: attribute.stride, filter: filter)
    var accessor = GLTFDocument.Accessor(
      bufferView: view, componentType: .byte, count: count, type: "VEC3")
    describe(&accessor)
    accessors.append(accessor)
    return accessors.count - 1
  }

  private mutating func append(
    triangles primitive: QuantizedPrimitive, _ encoder: some GLTFMeshEncoder
  ) throws -> Int {
    // The largest index of a type is reserved.
    let isShort = primitive.vertexCount <= Int(UInt16.max)
    let view = appendCompressed(
      try encoder.encode(triangles: primitive.indices, vertexCount: primitive.vertexCount),
      .triangles, count: primitive.indices.count, stride: isShort ? 2 : 4, filter: nil)
    accessors.append(
      .init(
        bufferView: view, componentType: isShort ? .unsignedShort : .unsignedInt,
        count: primitive.indices.count, type: "SCALAR"))
    return accessors.count - 1
  }

  /// Adds a view of the buffer without data, which refers to the compressed bytes.
  private mutating func appendCompressed(
    _ bytes: [UInt8], _ mode: GLTFDocument.CompressedView.Mode, count: Int, stride: Int,
    filter: GLTFDocument.CompressedView.Filter?
  ) -> Int {
    let start = binary.count
    binary.append(contentsOf: bytes)
    binary.align(to: 4)
    let isVertices = mode == .attributes
    views.append(
      .init(
        buffer: 1, byteOffset: decompressedSize, byteLength: count * stride,
        byteStride: isVertices ? stride : nil, target: isVertices ? .vertices : .indices,
        extensions: .init(
          meshopt: .init(
            byteOffset: start, byteLength: bytes.count, byteStride: stride, count: count,
            mode: mode, filter: filter))))
    decompressedSize += (count * stride + 3) / 4 * 4
    return views.count - 1
  }
}
