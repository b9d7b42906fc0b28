extension PhotogrammetrySession {
  /// A result to be made from the photos.
  public enum Request: Hashable, Sendable {
    /// A textured model in a file: `.usdz`, or a folder with OBJ, MTL, USDA and textures.
    case modelFile(url: URL, detail: Detail = .reduced, geometry: Geometry? = nil)
    /// A textured model in memory.
    case modelEntity(detail: Detail = .reduced, geometry: Geometry? = nil)
    /// The box around the object.
    case bounds
    /// Coloured points on the surface.
    case pointCloud
    /// The cameras' poses.
    case poses

    /// Asks for a model of reduced detail in a file.
    public init(modelFile: URL) { self = .modelFile(url: modelFile) }

    /// How detailed a model is.
    public enum Detail: Int, Hashable, Sendable {
      /// For a quick look: fewer than 25,000 triangles, a 1024² texture.
      case preview
      /// For mobile devices: fewer than 50,000 triangles, a 2048² texture.
      case reduced
      /// For most uses: fewer than 100,000 triangles, a 4096² texture.
      case medium
      /// For close looks: fewer than 250,000 triangles, an 8192² texture, all maps.
      case full
      /// As the reconstruction found it, for work that goes on.
      case raw
      /// As `Configuration.customDetailSpecification` says.
      case custom
    }

    /// The part of the scene that a model shows, and where it is put.
    public struct Geometry: Hashable, Sendable {
      /// The box, with its rotation, in the frame of `Request.bounds`; the model is cut off at its faces
      /// and left open there. An empty box keeps all.
      public var orientedBounds: OrientedBoundingBox
      /// What is applied to the model in the end, to its vertices.
      public var transform: Transform

      /// The box outside of which everything is cut off. Setting it makes it axis-aligned.
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

      /// Creates a geometry from a turned box.
      public init(
        orientedBounds: OrientedBoundingBox, transform: Transform = Transform.identity
      ) {
        self.orientedBounds = orientedBounds
        self.transform = transform
      }
    }
  }
}
