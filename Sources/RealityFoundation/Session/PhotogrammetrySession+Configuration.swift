extension PhotogrammetrySession {
  /// How a session treats its photos.
  public struct Configuration: Equatable, Sendable {
    /// Whether the object is separated from its support and its surroundings.
    public var isObjectMaskingEnabled = true
    /// Whether the order of the photos says which of them overlap.
    public var sampleOrdering = SampleOrdering.unordered
    /// How hard to look for features to match.
    public var featureSensitivity = FeatureSensitivity.normal
    /// A folder for intermediate results; a later run takes up what is still valid.
    public var checkpointDirectory: URL?
    /// What models of the detail level `custom` may have at most.
    public var customDetailSpecification = CustomDetailSpecification()
    /// The shape of the faces of models in files. Where triangles don't make a good quad they stay, so
    /// that a mesh of quads has some triangles; entities have nothing else.
    public var meshPrimitive = MeshPrimitive.triangle
    /// Whether to disregard the bounding boxes that samples carry. Samples made from pixels and those
    /// of JPEG and PNG files carry none.
    public var ignoreBoundingBox = false

    /// Creates the default configuration.
    public init() {}

    /// Creates the default configuration with a folder for intermediate results.
    public init(checkpointDirectory: URL) { self.checkpointDirectory = checkpointDirectory }

    /// Whether the order of the photos means something.
    public enum SampleOrdering: Hashable, Sendable {
      /// Any photo may overlap any other.
      case unordered
      /// Photos are in the order of capture, and neighbours overlap.
      case sequential
    }

    /// How hard to look for features.
    public enum FeatureSensitivity: Hashable, Sendable {
      /// For objects with enough texture.
      case normal
      /// For objects with little texture; takes longer.
      case high
    }

    /// The shape of a mesh's faces.
    public enum MeshPrimitive: Hashable, Sendable {
      /// Three vertices a face.
      case triangle
      /// Four vertices a face.
      case quad
    }
  }
}
