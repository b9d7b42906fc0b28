import SceneModel

/// Reads the triangles of one primitive of an untrusted glTF mesh.
enum GLTFPrimitive {
  private enum Mode: Int {
    case triangles = 4
    case strip = 5
    case fan = 6
  }

  /// The part of a primitive in the frame of its mesh; nil for points and lines. Throws a
  /// `FormatFault`, or an `UnsupportedFeature`.
  static func part(
    _ primitive: GLTFContent.Primitive, _ materials: inout GLTFMaterials,
    _ buffers: inout GLTFBuffers
  ) throws -> LoadedModel.Part? {
    guard let mode = Mode(rawValue: primitive.mode ?? Mode.triangles.rawValue) else { return nil }
    guard let position = primitive.attributes["POSITION"] else { return nil }
    var part = LoadedModel.Part()
    part.positions = try buffers.vectors3(position)
    let count = part.positions.count
    part.triangles = try triangles(primitive, mode, vertexCount: count, &buffers)
    if let normal = primitive.attributes["NORMAL"] {
      part.normals = try buffers.vectors3(normal)
    }
    let appearance = try materials.appearance(primitive.material, &buffers)
    (part.baseColor, part.baseColorFactor) = (appearance.image, appearance.factor)
    if let set = primitive.attributes["TEXCOORD_\(appearance.coordinates)"] {
      part.textureCoordinates = try buffers.vectors2(set).map {
        // In glTF, (0, 0) is the top left.
        let st = appearance.transform == .identity ? $0 : appearance.transform * $0
        return SIMD2(st.x, 1 - st.y)
      }
    }
    if let color = primitive.attributes["COLOR_0"] {
      part.colors = try colors(color, &buffers)
    }
    let counts = [part.normals.count, part.textureCoordinates.count, part.colors.count]
    guard counts.allSatisfy({ $0 == 0 || $0 == count }) else {
      throw FormatFault("the attributes of a mesh have different numbers of vertices")
    }
    return part
  }

  private static func colors(
    _ accessor: Int, _ buffers: inout GLTFBuffers
  ) throws -> [SIMD3<UInt8>] {
    let (n, width) = try buffers.vectors(accessor)
    guard width >= 3 else { throw FormatFault("its accessor \(accessor) is not a color") }
    return stride(from: 0, to: n.count, by: width).map {
      LinearColor([n[$0], n[$0 + 1], n[$0 + 2]]).bytes
    }
  }

  private static func triangles(
    _ primitive: GLTFContent.Primitive, _ mode: Mode, vertexCount: Int,
    _ buffers: inout GLTFBuffers
  ) throws -> [Triangle] {
    let indices =
      try primitive.indices.map { try buffers.indices($0) }
      ?? Array(0..<UInt32(clamping: vertexCount))
    guard indices.allSatisfy({ $0 < vertexCount }) else {
      throw FormatFault("a triangle refers to a vertex that does not exist")
    }
    guard indices.count >= 3 else { return [] }
    switch mode {
    case .triangles:
      return stride(from: 0, to: indices.count - 2, by: 3).map {
        Triangle(indices[$0], indices[$0 + 1], indices[$0 + 2])
      }
    case .strip:
      return (0..<indices.count - 2).map {
        let swap = $0 % 2
        return Triangle(indices[$0], indices[$0 + 1 + swap], indices[$0 + 2 - swap])
      }
    case .fan:
      return (1..<indices.count - 1).map {
        Triangle(indices[0], indices[$0], indices[$0 + 1])
      }
    }
  }
}
