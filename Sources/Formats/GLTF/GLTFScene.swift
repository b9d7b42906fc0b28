import SceneModel

/// Collects the triangles of the nodes of an untrusted glTF scene.
struct GLTFScene {
  /// Limit: the stack of a thread has an end; real scenes are not nested as deeply.
  private static let maximumDepth = 128

  private let content: GLTFContent
  private var meshes: [Int: [LoadedModel.Part]] = [:]
  private var materials: GLTFMaterials
  private var parts: [LoadedModel.Part] = []

  /// The model in the scene of a file. Throws a `FormatFault`, or an `UnsupportedFeature`.
  static func model(_ content: GLTFContent, _ buffers: inout GLTFBuffers) throws -> LoadedModel {
    var scene = GLTFScene(content: content)
    for node in try scene.roots() { try scene.visit(node, .identity, depth: 0, &buffers) }
    return LoadedModel(parts: scene.parts, missingFiles: scene.materials.missingFiles)
  }

  private init(content: GLTFContent) {
    self.content = content
    materials = GLTFMaterials(content: content)
  }

  /// The root nodes of the scene; without scenes, the nodes that aren't children.
  private func roots() throws -> [Int] {
    if let scenes = content.scenes, !scenes.isEmpty {
      return try GLTFBuffers.element(scenes, content.scene ?? 0, "scene").nodes ?? []
    }
    let nodes = content.nodes ?? []
    let children = Set(nodes.flatMap { $0.children ?? [] })
    return nodes.indices.filter { !children.contains($0) }
  }

  private mutating func visit(
    _ index: Int, _ parent: NodeTransform, depth: Int, _ buffers: inout GLTFBuffers
  ) throws {
    guard depth < Self.maximumDepth else {
      throw FormatFault("its nodes are nested too deeply, or form a circle")
    }
    let node = try GLTFBuffers.element(content.nodes, index, "node")
    // Counts the visits: nodes that share children could double them at every level.
    try buffers.budget.spend(MemoryLayout<GLTFContent.Node>.stride)
    let transform = parent * node.transform
    if let mesh = node.mesh {
      for part in try parts(of: mesh, &buffers) {
        try buffers.budget.spend(part.positions.count, of: 4 * MemoryLayout<Float>.stride)
        parts.append(transform.applied(to: part))
      }
    }
    for child in node.children ?? [] {
      try visit(child, transform, depth: depth + 1, &buffers)
    }
  }

  /// The parts of a mesh in its own frame.
  private mutating func parts(
    of index: Int, _ buffers: inout GLTFBuffers
  ) throws -> [LoadedModel.Part] {
    if let parts = meshes[index] { return parts }
    let mesh = try GLTFBuffers.element(content.meshes, index, "mesh")
    let parts = try mesh.primitives.compactMap { primitive in
      try GLTFPrimitive.part(primitive, &materials, &buffers)
    }
    meshes[index] = parts
    return parts
  }
}

extension GLTFContent.Node {
  /// `parentFromNode`.
  fileprivate var transform: NodeTransform {
    if let matrix { return NodeTransform(elements: matrix) ?? .identity }
    var result = NodeTransform.identity
    if let t = translation, t.count == 3 { result.translation = SIMD3(t[0], t[1], t[2]) }
    if let q = rotation, q.count == 4 {
      result = result * .rotation(Quaternion(x: q[0], y: q[1], z: q[2], w: q[3]))
    }
    if let s = scale, s.count == 3 { result = result * .scale(SIMD3(s[0], s[1], s[2])) }
    return result
  }
}
