import SceneModel

/// A primitive with small integers as vertex attributes (`KHR_mesh_quantization`), in the order in
/// which it compresses well.
struct QuantizedPrimitive {
  /// The bytes of an attribute: `stride` per vertex, with zeros as padding.
  struct Attribute {
    var bytes: [UInt8] = []
    var stride: Int
  }

  let vertexCount: Int
  /// Grid coordinates, three unsigned shorts.
  private(set) var positions = Attribute(stride: 8)
  /// The bounds of the grid coordinates.
  private(set) var bounds: (min: SIMD3<UInt16>, max: SIMD3<UInt16>)
  /// Unit vectors in the octahedral encoding; nil without normals.
  private(set) var normals: Attribute?
  /// Two normalized unsigned shorts; nil without texture.
  private(set) var textureCoordinates: Attribute?
  /// Three vertices per triangle.
  let indices: [UInt32]

  init(
    _ primitive: IndexedTriangles, of mesh: TexturedMesh, in grid: PositionGrid,
    orderedBy encoder: some GLTFMeshEncoder
  ) throws {
    let order = try encoder.order(primitive.indices, vertexCount: primitive.positions.count)
    var oldFromNew = [Int](repeating: 0, count: primitive.positions.count)
    for (old, new) in order.newFromOld.enumerated() where new < oldFromNew.count {
      oldFromNew[Int(new)] = old
    }
    indices = order.indices
    vertexCount = oldFromNew.count
    let points = oldFromNew.map {
      grid.coordinates(of: mesh.mesh.positions[Int(primitive.positions[$0])])
    }
    bounds = (
      points.reduce(points.first ?? .zero, pointwiseMin), points.reduce(.zero, pointwiseMax)
    )
    positions.bytes = Self.bytes(points) { [$0.x, $0.y, $0.z, 0] }
    if mesh.mesh.normals.count == mesh.mesh.positions.count {
      let vectors = oldFromNew.map { mesh.mesh.normals[Int(primitive.positions[$0])] }
      normals = Attribute(bytes: vectors.flatMap(OctahedralNormal.encode), stride: 4)
    }
    guard !primitive.coordinates.isEmpty else { return }
    let coordinates = oldFromNew.map { mesh.textureCoordinates[Int(primitive.coordinates[$0])] }
    textureCoordinates = Attribute(
      bytes: Self.bytes(coordinates) { [Self.normalized($0.x), Self.normalized(1 - $0.y)] },
      stride: 4)
  }

  /// 0…1 as 16 bits: an error of at most a sixteenth of a texel with the largest atlases, of 8192
  /// texels per side. With 12 bits it would be a quarter of a texel of an atlas of 2048.
  private static func normalized(_ value: Float) -> UInt16 {
    value > 0 ? UInt16((min(value, 1) * 65535).rounded()) : 0
  }

  private static func bytes<Value>(
    _ values: [Value], _ shorts: (Value) -> [UInt16]
  ) -> [UInt8] {
    var writer = ByteWriter()
    for value in values { for short in shorts(value) { writer.append(short) } }
    return writer.bytes
  }
}
