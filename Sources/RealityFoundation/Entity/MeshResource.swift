/// A triangle mesh.
public final class MeshResource: Sendable {
  /// The parts of the mesh.
  public let contents: Contents
  /// The bounding box of the mesh.
  public let bounds: BoundingBox

  /// Creates a mesh from its parts.
  init(_ contents: Contents) {
    self.contents = contents
    bounds = contents.models.lazy.flatMap(\.parts).flatMap(\.positions)
      .reduce(into: BoundingBox.empty) { $0.formUnion($1) }
  }

  /// The number of materials that the mesh refers to.
  public var expectedMaterialCount: Int {
    contents.models.lazy.flatMap(\.parts).map { $0.materialIndex + 1 }.max() ?? 0
  }

  /// The parts of a mesh.
  public struct Contents: Sendable {
    /// The models.
    public var models: MeshModelCollection
    /// The instances of the models.
    public var instances: MeshInstanceCollection
  }

  /// A model that may be instantiated several times.
  public struct Model: Identifiable, Sendable {
    /// The name of the model.
    public let id: String
    /// The parts, one for each material.
    public var parts: MeshPartCollection
  }

  /// An instance of a model.
  public struct Instance: Identifiable, Sendable {
    /// The name of the instance.
    public let id: String
    /// The name of the model that is instantiated.
    public var model: String
    /// The transform of the instance.
    public var transform: float4x4
  }

  /// Triangles of one material.
  public struct Part: Identifiable, Sendable {
    /// The name of the part.
    public let id: String
    /// The index of its material in `ModelComponent.materials`.
    public var materialIndex: Int
    /// The positions of the vertices.
    public var positions: MeshBuffer<SIMD3<Float>>
    /// The unit normals of the vertices.
    public var normals: MeshBuffer<SIMD3<Float>>?
    /// The texture coordinates of the vertices; (0, 0) is the bottom left of the texture.
    public var textureCoordinates: MeshBuffer<SIMD2<Float>>?
    /// Three vertex indices per triangle, counterclockwise from outside.
    public var triangleIndices: MeshBuffer<UInt32>?
  }
}

extension MeshResource: Hashable {
  /// Whether both are the same mesh.
  public static func == (lhs: MeshResource, rhs: MeshResource) -> Bool { lhs === rhs }

  /// Hashes the identity of the mesh.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}

/// The models of a mesh.
public typealias MeshModelCollection = MeshElements<MeshResource.Model>
/// The instances of a mesh.
public typealias MeshInstanceCollection = MeshElements<MeshResource.Instance>
/// The parts of a model.
public typealias MeshPartCollection = MeshElements<MeshResource.Part>
