extension PhotogrammetrySession {
  /// A result to be made from the photos.
  public enum Request: Hashable, Sendable {
    /// A textured model in a file: `.usdz`, or a folder with OBJ, MTL, USDA and textures.
    case modelFile(url: URL, detail: Detail = .reduced, geometry: Geometry? = nil)
    /// A textured model in memory.
    case modelEntity(detail: Detail = .reduced, geometry: Geometry? = nil)
    /// The bounding box of the object.
    case bounds
    /// Colored points on the surface.
    case pointCloud
    /// The camera poses.
    case poses

    /// Creates a request for a model file with the detail level `reduced`.
    public init(modelFile: URL) { self = .modelFile(url: modelFile) }

    /// The level of detail of a model.
    public enum Detail: Int, Hashable, Sendable {
      /// For previews: fewer than 25,000 triangles, a 1024² texture.
      case preview
      /// For mobile devices: fewer than 50,000 triangles, a 2048² texture.
      case reduced
      /// For most uses: fewer than 100,000 triangles, a 4096² texture.
      case medium
      /// For close-ups: fewer than 250,000 triangles, an 8192² texture, all maps.
      case full
      /// The full reconstruction, for further processing.
      case raw
      /// The limits of `Configuration.customDetailSpecification`.
      case custom
    }

    /// The part of the scene that a model contains, and a transform of the model.
    public struct Geometry: Hashable, Sendable {
      /// The oriented crop box in the frame of `Request.bounds`; the model is clipped at its faces
      /// and left open there. An empty box keeps everything.
      public var orientedBounds: OrientedBoundingBox
      /// The transform that is applied to the vertices last.
      public var transform: Transform

      /// The axis-aligned crop box. Setting it discards the orientation.
      public var bounds: BoundingBox {
        get { orientedBounds.boundingBox }
        set { orientedBounds = OrientedBoundingBox(boundingBox: newValue) }
      }

      /// Creates a geometry from an axis-aligned box.
      public init(
        bounds: BoundingBox = BoundingBox.empty, transform: Transform = Transform.identity
      ) {
        self.init(
          orientedBounds: OrientedBoundingBox(boundingBox: bounds), transform: transform)
      }

      /// Creates a geometry from an oriented box.
      public init(
        orientedBounds: OrientedBoundingBox, transform: Transform = Transform.identity
      ) {
        self.orientedBounds = orientedBounds
        self.transform = transform
      }
    }
  }
}
