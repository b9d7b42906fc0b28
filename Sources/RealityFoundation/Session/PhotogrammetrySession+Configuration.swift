extension PhotogrammetrySession {
  /// How a session processes its photos.
  public struct Configuration: Equatable, Sendable {
    /// Whether to separate the object from its support and its surroundings.
    public var isObjectMaskingEnabled = true
    /// Whether the order of the photos indicates which of them overlap.
    public var sampleOrdering = SampleOrdering.unordered
    /// The sensitivity of feature detection.
    public var featureSensitivity = FeatureSensitivity.normal
    /// A folder for intermediate results; a later run reuses those that are still valid.
    public var checkpointDirectory: URL?
    /// The limits of the detail level `custom`.
    public var customDetailSpecification = CustomDetailSpecification()
    /// The primitive of the mesh in model files. Triangles that don't form a good quad remain, so a
    /// mesh of quads contains some triangles; entities consist of triangles only.
    public var meshPrimitive = MeshPrimitive.triangle
    /// Whether to ignore the bounding boxes of samples. Samples made from pixels or from JPEG and
    /// PNG files have none.
    public var ignoreBoundingBox = false

    /// Creates the default configuration.
    public init() {}

    /// Creates the default configuration with a folder for intermediate results.
    public init(checkpointDirectory: URL) { self.checkpointDirectory = checkpointDirectory }

    /// Whether the order of the photos is meaningful.
    public enum SampleOrdering: Hashable, Sendable {
      /// Any photo may overlap any other.
      case unordered
      /// Photos are in the order of capture, and adjacent ones overlap.
      case sequential
    }

    /// The sensitivity of feature detection.
    public enum FeatureSensitivity: Hashable, Sendable {
      /// For objects with enough texture.
      case normal
      /// For objects with little texture; slower.
      case high
    }

    /// The primitive of a mesh.
    public enum MeshPrimitive: Hashable, Sendable {
      /// Faces with three vertices.
      case triangle
      /// Faces with four vertices.
      case quad
    }
  }
}
