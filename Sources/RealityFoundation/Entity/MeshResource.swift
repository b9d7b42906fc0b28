/// A shape of triangles.
public final class MeshResource: Sendable {
  /// Everything that the shape consists of.
  public let contents: Contents
  /// The box around the shape.
  public let bounds: BoundingBox

  /// Creates a shape from its parts.
  init(_ contents: Contents) {
    self.contents = contents
    bounds = contents.models.lazy.flatMap(\.parts).flatMap(\.positions)
      .reduce(into: BoundingBox.empty) { $0.formUnion($1) }
  }

  /// The number of materials that the shape refers to.
  public var expectedMaterialCount: Int {
    contents.models.lazy.flatMap(\.parts).map { $0.materialIndex + 1 }.max() ?? 0
  }

  /// What a shape consists of.
  public struct Contents: Sendable {
    /// The shapes.
    public var models: MeshModelCollection
    /// Where the shapes stand.
    public var instances: MeshInstanceCollection
  }

  /// A shape that may stand at several places.
  public struct Model: Identifiable, Sendable {
    /// The name of the shape.
    public let id: String
    /// The parts of different materials.
    public var parts: MeshPartCollection
  }

  /// A place of a shape.
  public struct Instance: Identifiable, Sendable {
    /// The name of the instance.
    public let id: String
    /// The name of the shape that stands there.
    public var model: String
    /// The place.
    public var transform: float4x4
  }

  /// Triangles of one material.
  public struct Part: Identifiable, Sendable {
    /// The name of the part.
    public let id: String
    /// The place of its material in `ModelComponent.materials`.
    public var materialIndex: Int
    /// The places of the vertices.
    public var positions: MeshBuffer<SIMD3<Float>>
    /// The unit normals of the vertices.
    public var normals: MeshBuffer<SIMD3<Float>>?
    /// The texture coordinates of the vertices; (0, 0) is the bottom left of the texture.
    public var textureCoordinates: MeshBuffer<SIMD2<Float>>?
    /// Three vertices a triangle, counter-clockwise seen from outside.
    public var triangleIndices: MeshBuffer<UInt32>?
  }
}

extension MeshResource: Hashable {
  /// Whether both are the same shape.
  public static func == (lhs: MeshResource, rhs: MeshResource) -> Bool { lhs === rhs }

  /// Hashes the identity of the shape.
  public func hash(into hasher: inout Hasher) { hasher.combine(ObjectIdentifier(self)) }
}

/// The shapes of a mesh.
public typealias MeshModelCollection = MeshElements<MeshResource.Model>
/// The places of a mesh's shapes.
public typealias MeshInstanceCollection = MeshElements<MeshResource.Instance>
/// The parts of a shape.
public typealias MeshPartCollection = MeshElements<MeshResource.Part>
