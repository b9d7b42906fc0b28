import ArgumentParser

/// The part of the surface that a model shows, and the kind of its faces.
package struct ShapeArguments: ParsableArguments {
  @Option(
    name: .long, parsing: .unconditional,
    help: ArgumentHelp(
      "Crop the model to the box with these opposite corners, in the model's frame and unit.",
      valueName: "x,y,z,x,y,z"))
  package var crop: BoxArgument?

  @Flag(
    name: .long,
    help: "Merge pairs of triangles into quads where they fit together; GLB has triangles only.")
  package var quads = false

  package init() {}

  /// The crop box of a session's request; nil for the whole surface.
  package var geometry: PhotogrammetrySession.Request.Geometry? {
    crop.map { .init(bounds: $0.box) }
  }

  /// The kind of faces in a session's configuration.
  package var primitive: PhotogrammetrySession.Configuration.MeshPrimitive {
    quads ? .quad : .triangle
  }
}
